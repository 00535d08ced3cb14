// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "solids.h"

#include <fmt/format.h>
#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "../error.h"
#include "../polygon.h"

namespace scanworld {

namespace {

// A prism with `base` counter-clockwise seen from below, against the direction of `extrusion`: both
// its ends, as fans, and its sides.
Mesh extrude(const std::vector<Vec3>& base, const Vec3& extrusion) {
  Mesh mesh;
  mesh.vertices = base;
  for (const Vec3& v : base) mesh.vertices.push_back(v + extrusion);
  const int n = static_cast<int>(base.size());
  for (int i = 1; i + 1 < n; ++i) {
    mesh.triangles.push_back({0, i, i + 1});
    mesh.triangles.push_back({n, n + i + 1, n + i});
  }
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    mesh.triangles.push_back({i, n + i, n + next});
    mesh.triangles.push_back({i, n + next, next});
  }
  return mesh;
}

// The library's state, freed whatever happens.
struct Qhull {
  qhT qh;
  Qhull() { qh_zero(&qh, nullptr); }
  ~Qhull() {
    qh_freeqhull(&qh, !qh_ALL);
    int left = 0, blocks = 0;
    qh_memfreeshort(&qh, &left, &blocks);
  }
};

}  // namespace

Mesh mesh_of(const OrientedBox& box) {
  const auto corner = [&](double x, double y, double z) {
    return Vec3(box.center + box.rotation * Vec3(x, y, z).cwiseProduct(box.size / 2));
  };
  return extrude({corner(-1, -1, -1), corner(-1, 1, -1), corner(1, 1, -1), corner(1, -1, -1)},
                 box.rotation * Vec3(0, 0, box.size.z()));
}

Mesh mesh_of(const ConvexPrism& prism) {
  const Vec3 normal = doubled_area(prism.base);
  std::vector<Vec3> base = prism.base;
  if (normal.dot(prism.extrusion) > 0) std::reverse(base.begin(), base.end());
  return extrude(base, prism.extrusion);
}

Mesh mesh_of(const Cylinder& cylinder, const Vec3& up, int facets) {
  const PlaneFrame frame = frame_of({up, 0});
  std::vector<Vec3> base;
  for (int i = facets; i-- > 0;) {  // clockwise seen from above
    const double angle = 2 * M_PI * i / facets;
    base.push_back(cylinder.center - up * cylinder.height / 2 +
                   cylinder.radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v));
  }
  return extrude(base, up * cylinder.height);
}

Mesh mesh_of(const ConvexHull& hull) {
  std::vector<coordT> coordinates;
  for (const Vec3& v : hull.vertices) coordinates.insert(coordinates.end(), {v.x(), v.y(), v.z()});
  Qhull state;
  qhT* qh = &state.qh;
  char command[] = "qhull Qt Pp";  // triangles only, no warnings
  std::FILE* silent = std::fopen("/dev/null", "w");
  const int failed = hull.vertices.size() < 4
                         ? 1
                         : qh_new_qhull(qh, 3, static_cast<int>(hull.vertices.size()),
                                        coordinates.data(), 0, command, nullptr, silent);
  if (silent) std::fclose(silent);
  if (failed)
    throw Error(Cause::check_failed,
                fmt::format("a hull of {} points has no volume", hull.vertices.size()));

  Mesh mesh;
  std::map<int, int> index_of;  // points that are corners of the hull
  facetT* facet = nullptr;
  FORALLfacets {
    std::array<int, 3> triangle{};
    std::size_t k = 0;
    vertexT *vertex = nullptr, **vertexp = nullptr;
    FOREACHvertex_(facet->vertices) {
      const int point = qh_pointid(qh, vertex->point);
      const auto [found, is_new] =
          index_of.try_emplace(point, static_cast<int>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back(hull.vertices[static_cast<std::size_t>(point)]);
      if (k < 3) triangle[k++] = found->second;
    }
    const Vec3 &a = mesh.vertices[static_cast<std::size_t>(triangle[0])],
               &b = mesh.vertices[static_cast<std::size_t>(triangle[1])],
               &c = mesh.vertices[static_cast<std::size_t>(triangle[2])];
    if ((b - a).cross(c - a).dot(Vec3(facet->normal[0], facet->normal[1], facet->normal[2])) < 0)
      std::swap(triangle[1], triangle[2]);
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

Mesh mesh_of(const Obstacle& obstacle, const Frame& frame) {
  if (const auto* box = std::get_if<OrientedBox>(&obstacle.shape)) return mesh_of(*box);
  if (const auto* hull = std::get_if<ConvexHull>(&obstacle.shape)) return mesh_of(*hull);
  return mesh_of(std::get<Cylinder>(obstacle.shape), frame.up);
}

bool contains(const Mesh& convex, const Vec3& point) {
  return std::all_of(convex.triangles.begin(), convex.triangles.end(), [&](const auto& t) {
    const auto at = [&](std::size_t k) -> const Vec3& {
      return convex.vertices[static_cast<std::size_t>(t[k])];
    };
    return (at(1) - at(0)).cross(at(2) - at(0)).dot(point - at(0)) <= 0;
  });
}

double volume_of(const Mesh& mesh) {
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) {
      return Vec3(mesh.vertices[static_cast<std::size_t>(t[k])] - mesh.vertices[0]);
    };
    volume += at(0).dot(at(1).cross(at(2))) / 6;
  }
  return volume;
}

Vec3 vector_area(const Mesh& mesh, std::size_t triangle) {
  const auto at = [&](std::size_t k) -> const Vec3& {
    return mesh.vertices[static_cast<std::size_t>(mesh.triangles[triangle][k])];
  };
  return (at(1) - at(0)).cross(at(2) - at(0)) / 2;
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) area += vector_area(mesh, i).norm();
  return area;
}

}  // namespace scanworld
