// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "walls.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "../parallel.h"
#include "../point_sums.h"
#include "hull.h"

namespace scanworld::thesis {

namespace {

constexpr double kFrontDepth = 4;  // [m] how far before and behind a polygon the place is looked at
constexpr std::size_t kFrontPoints = 20000;  // of all points so many are looked at, about

std::vector<PointSums> add_up(const PointCloud& cloud, const std::vector<std::int32_t>& labels,
                              const std::vector<Cluster>& clusters) {
  constexpr std::size_t kPart = 1 << 20;
  std::vector<std::vector<PointSums>> parts(part_count(labels.size(), kPart),
                                            std::vector<PointSums>(clusters.size()));
  parallel_for(parts.size(), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, labels.size(), kPart);
    for (std::size_t i = begin; i < end; ++i) {
      if (labels[i] < 0) continue;
      const std::size_t c = static_cast<std::size_t>(labels[i]);
      parts[part][c].add(cloud, i, clusters[c].fit.plane);
    }
  });
  std::vector<PointSums> all(clusters.size());
  for (const std::vector<PointSums>& part : parts)
    for (std::size_t c = 0; c < all.size(); ++c) all[c] += part[c];
  return all;
}

Vec3 middle_of(const Polygon& polygon) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& v : polygon) sum += v;
  return sum / static_cast<double>(polygon.size());
}

bool is_inside(const Vec3& p, const Polygon& polygon, const Vec3& normal) {
  for (std::size_t i = 0; i < polygon.size(); ++i)
    if (is_seeing(p, polygon[i], polygon[(i + 1) % polygon.size()], normal)) return false;
  return true;
}

// How many more points of each cluster were seen from before its plane than from behind, by the
// viewpoints that they know.
std::vector<std::int64_t> count_viewers(const PointCloud& cloud,
                                        const std::vector<std::int32_t>& labels,
                                        const std::vector<Cluster>& clusters) {
  std::vector<std::int64_t> votes(clusters.size());
  for (std::size_t i = 0; i < cloud.viewers.size(); ++i) {
    if (labels[i] < 0 || cloud.viewers[i] < 0) continue;
    const auto c = static_cast<std::size_t>(labels[i]);
    const Vec3& from = cloud.viewpoints[static_cast<std::size_t>(cloud.viewers[i])];
    votes[c] += clusters[c].fit.plane.signed_distance(from) > 0 ? 1 : -1;
  }
  return votes;
}

// Positive where the free side is the one that the plane's normal points to.
double free_side(const Plane& plane, const Polygon& polygon, const std::vector<Vec3>& viewpoints,
                 const std::vector<Vec3>& points) {
  if (!viewpoints.empty()) return plane.signed_distance(nearest_of(viewpoints, middle_of(polygon)));
  double sum = 0;
  const std::size_t step = points.size() / kFrontPoints + 1;
  for (std::size_t i = 0; i < points.size(); i += step) {
    const double distance = plane.signed_distance(points[i]);
    if (std::abs(distance) < kFrontDepth && is_inside(points[i], polygon, plane.normal))
      sum += distance;
  }
  return sum;
}

// The share of the polygon's cells of two delta that hold one of the cluster's points.
double coverage(const Cluster& cluster, const Polygon& polygon, const std::vector<Vec3>& points,
                double delta) {
  const PlaneFrame frame = frame_of(cluster.fit.plane, polygon[0]);
  const double size = 2 * delta;
  const auto cell_at = [&](const Vec3& p) {
    const Vec2 q = (frame.to_plane(p) / size).array().floor();
    return std::pair{static_cast<int>(q.x()), static_cast<int>(q.y())};
  };
  std::set<std::pair<int, int>> occupied;
  for (int p : cluster.members) occupied.insert(cell_at(points[static_cast<std::size_t>(p)]));
  auto low = cell_at(polygon[0]), high = low;
  for (const Vec3& v : polygon) {
    const auto cell = cell_at(v);
    low = {std::min(low.first, cell.first), std::min(low.second, cell.second)};
    high = {std::max(high.first, cell.first), std::max(high.second, cell.second)};
  }
  std::size_t inside = 0, covered = 0;
  for (int i = low.first; i <= high.first; ++i)
    for (int j = low.second; j <= high.second; ++j) {
      if (!is_inside(frame.to_space(Vec2((i + 0.5) * size, (j + 0.5) * size)), polygon,
                     cluster.fit.plane.normal))
        continue;
      ++inside;
      covered += occupied.count({i, j});
    }
  return inside > 0 ? static_cast<double>(covered) / static_cast<double>(inside) : 1;
}

}  // namespace

std::vector<FoundSurface> describe_walls(const PointCloud& cloud,
                                         const std::vector<std::int32_t>& labels,
                                         const std::vector<Vec3>& points, double delta,
                                         const std::vector<Cluster>& clusters,
                                         const std::vector<Polygon>& polygons) {
  const std::vector<PointSums> sums = add_up(cloud, labels, clusters);
  const std::vector<std::int64_t> viewers = count_viewers(cloud, labels, clusters);
  std::vector<FoundSurface> walls(clusters.size());
  parallel_for(clusters.size(), [&](std::size_t c) {
    FoundSurface wall{.plane = clusters[c].fit.plane, .outer = polygons[c]};
    if (polygons[c].size() >= 3) {
      wall.support.coverage = coverage(clusters[c], polygons[c], points, delta);
      const double side = viewers[c] != 0
                              ? static_cast<double>(viewers[c])
                              : free_side(wall.plane, wall.outer, cloud.viewpoints, points);
      if (side < 0) {
        wall.plane = wall.plane.flipped();
        std::reverse(wall.outer.begin(), wall.outer.end());
      }
    }
    sums[c].describe(cloud, wall);
    walls[c] = std::move(wall);
  });
  return walls;
}

}  // namespace scanworld::thesis
