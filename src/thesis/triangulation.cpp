// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "triangulation.h"

#include <limits>
#include <numeric>

namespace scanworld::thesis {

namespace {

// How far inside the circle through a, b and c the point p lies, by the in-circle determinant over
// the triangle's area: positive inside. Without bound for a triangle without area.
double depth_in_circle(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& c) {
  const double area = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  if (area <= 0) return std::numeric_limits<double>::infinity();
  Mat3 m;
  m << (a - p).x(), (a - p).y(), (a - p).squaredNorm(), (b - p).x(), (b - p).y(),
      (b - p).squaredNorm(), (c - p).x(), (c - p).y(), (c - p).squaredNorm();
  return m.determinant() / area;
}

}  // namespace

std::vector<std::array<int, 3>> triangulate_convex(const std::vector<Vec3>& vertices,
                                                   const Vec3& normal) {
  std::vector<std::array<int, 3>> triangles;
  if (vertices.size() < 3) return triangles;
  const PlaneFrame frame = frame_of(plane_through(vertices[0], normal), vertices[0]);
  std::vector<Vec2> points;
  for (const Vec3& v : vertices) points.push_back(frame.to_plane(v));
  std::vector<int> left(vertices.size());
  std::iota(left.begin(), left.end(), 0);
  const auto point = [&](int index) { return points[static_cast<std::size_t>(index)]; };

  while (left.size() > 2) {
    const std::size_t n = left.size();
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < n; ++i) {
      const int before = left[(i + n - 1) % n], here = left[i], after = left[(i + 1) % n];
      double deepest = -std::numeric_limits<double>::infinity();
      for (int other : left)
        if (other != before && other != here && other != after)
          deepest = std::max(
              deepest, depth_in_circle(point(other), point(before), point(here), point(after)));
      if (deepest < least) least = deepest, best = i;
      if (deepest <= 0) break;  // meets the Delaunay condition
    }
    triangles.push_back({left[(best + n - 1) % n], left[best], left[(best + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return triangles;
}

std::vector<std::vector<std::array<int, 3>>> triangulate(const std::vector<Polygon>& polygons,
                                                         const std::vector<Cluster>& clusters) {
  std::vector<std::vector<std::array<int, 3>>> triangles;
  for (std::size_t i = 0; i < polygons.size(); ++i)
    triangles.push_back(triangulate_convex(polygons[i], clusters[i].fit.plane.normal));
  return triangles;
}

}  // namespace scanworld::thesis
