// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "merge_planes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scanworld::surface {

namespace {

// The corners of one edge are near many planes: those at a larger angle cut something else.
constexpr double kMinCosine = 0.9;

// The corners that name a plane.
struct Extent {
  std::vector<Vec3> corners;
  Box3 box;
  bool is_surface = false;  // a polygon's

  void add(const Vec3& corner) { corners.push_back(corner), box.extend(corner); }
  double farthest_from(const Plane& plane) const {
    double most = 0;
    for (const Vec3& c : corners) most = std::max(most, std::abs(plane.signed_distance(c)));
    return most;
  }
};

// Of a polygon's plane only the polygons' own corners count: where others end at it, they follow.
std::vector<Extent> find_extents(const std::vector<CornerPolygon>& polygons, std::size_t planes) {
  std::vector<Extent> extents(planes);
  for (const CornerPolygon& polygon : polygons)
    extents[static_cast<std::size_t>(polygon.patch)].is_surface = true;
  for (const CornerPolygon& polygon : polygons)
    for (const auto& loop : polygon.loops)
      for (const Corner& corner : loop)
        for (int plane : corner.planes) {
          Extent& extent = extents[static_cast<std::size_t>(plane)];
          if (!extent.is_surface || plane == polygon.patch) extent.add(corner.at);
        }
  return extents;
}

}  // namespace

std::vector<int> merge_planes(const std::vector<CornerPolygon>& polygons,
                              const std::vector<Plane>& planes, const WeldOptions& options) {
  const std::vector<Extent> extents = find_extents(polygons, planes.size());
  std::vector<int> name(planes.size());
  std::iota(name.begin(), name.end(), 0);
  std::vector<std::size_t> order(planes.size()), kept;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t k) { return extents[k].is_surface; });
  for (std::size_t k : order) {
    const Extent& own = extents[k];
    if (own.corners.empty()) continue;
    double least = own.is_surface ? options.off_plane / 2 : options.same;
    for (std::size_t other : kept) {
      const Box3 near = grown(extents[other].box, options.same);
      if (!near.intersects(own.box) ||
          std::abs(planes[other].normal.dot(planes[k].normal)) < kMinCosine)
        continue;
      const double off = own.farthest_from(planes[other]);
      if (off < least) least = off, name[k] = static_cast<int>(other);
    }
    if (name[k] == static_cast<int>(k)) kept.push_back(k);
  }
  return name;
}

}  // namespace scanworld::surface
