// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "snapping.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "../parallel.h"
#include "hull.h"

namespace scanworld::thesis {

namespace {

class Snapper {
 public:
  Snapper(const std::vector<Cluster>& clusters, const KdTree& tree, double delta,
          const SnappingOptions& options)
      : clusters_(clusters),
        tree_(tree),
        max_distance_(options.max_distance * delta),
        evidence_(Vec3::Constant(options.evidence_range * delta)),
        min_sine_(std::sin(options.min_angle)),
        owner_(tree.points().size(), -1) {
    for (std::size_t c = 0; c < clusters.size(); ++c)
      for (int p : clusters[c].members) owner_[static_cast<std::size_t>(p)] = static_cast<int>(c);
  }

  Vec3 snap(const Vec3& vertex, int own) const {
    const Vec3 reach = evidence_ + Vec3::Constant(max_distance_);
    const std::vector<int> others = clusters_near(vertex, reach, own);
    Nearest corner{max_distance_, vertex};
    for (std::size_t i = 0; i < others.size(); ++i)
      for (std::size_t k = i + 1; k < others.size(); ++k)
        if (const auto at = corner_of({own, others[i], others[k]})) corner.offer(vertex, *at);
    if (corner.found) return corner.at;
    Nearest line{max_distance_, vertex};
    for (int other : others)
      if (const auto at = nearest_on_line(vertex, own, other)) line.offer(vertex, *at);
    return line.at;
  }

 private:
  struct Nearest {
    double distance;
    Vec3 at;
    bool found = false;
    void offer(const Vec3& from, const Vec3& candidate) {
      const double d = (candidate - from).norm();
      if (d < distance) distance = d, at = candidate, found = true;
    }
  };

  const Plane& plane(int cluster) const {
    return clusters_[static_cast<std::size_t>(cluster)].fit.plane;
  }

  // The clusters, without `own`, that have a point in the box around `at`; ascending.
  std::vector<int> clusters_near(const Vec3& at, const Vec3& range, int own) const {
    std::vector<int> found;
    tree_.range_search(at - range, at + range, [&](int p) {
      const int c = owner_[static_cast<std::size_t>(p)];
      if (c >= 0 && c != own && std::find(found.begin(), found.end(), c) == found.end())
        found.push_back(c);
    });
    std::sort(found.begin(), found.end());
    return found;
  }

  bool has_point_near(const Vec3& at, int cluster) const {
    bool found = false;
    tree_.range_search(at - evidence_, at + evidence_,
                       [&](int p) { found |= owner_[static_cast<std::size_t>(p)] == cluster; });
    return found;
  }

  // Where three planes meet, where each of their clusters has points there. The planes are taken in
  // the order of their clusters, so that each of the three gets the same bits.
  std::optional<Vec3> corner_of(std::array<int, 3> walls) const {
    std::sort(walls.begin(), walls.end());
    Mat3 normals;
    Vec3 offsets;
    for (int k = 0; k < 3; ++k) {
      normals.row(k) = plane(walls[static_cast<std::size_t>(k)]).normal;
      offsets[k] = -plane(walls[static_cast<std::size_t>(k)]).offset;
    }
    for (int k = 0; k < 3; ++k)
      if (normals.row(k).cross(normals.row((k + 1) % 3)).norm() < min_sine_) return std::nullopt;
    // The volume of the normals is small too where the three lines are nearly parallel.
    if (std::abs(normals.determinant()) < min_sine_ * min_sine_) return std::nullopt;
    const Vec3 at = normals.partialPivLu().solve(offsets);
    for (int wall : walls)
      if (!has_point_near(at, wall)) return std::nullopt;
    return at;
  }

  std::optional<Vec3> nearest_on_line(const Vec3& vertex, int a, int b) const {
    const Vec3 direction = plane(a).normal.cross(plane(b).normal);
    if (direction.norm() < min_sine_) return std::nullopt;
    // The foot of the perpendicular from the vertex: on both planes, and in the plane across the
    // line.
    Mat3 rows;
    rows << plane(a).normal.transpose(), plane(b).normal.transpose(),
        direction.normalized().transpose();
    const Vec3 at = rows.partialPivLu().solve(
        Vec3(-plane(a).offset, -plane(b).offset, direction.normalized().dot(vertex)));
    if (!has_point_near(at, a) || !has_point_near(at, b)) return std::nullopt;
    return at;
  }

  const std::vector<Cluster>& clusters_;
  const KdTree& tree_;
  const double max_distance_;
  const Vec3 evidence_;
  const double min_sine_;
  std::vector<int> owner_;  // of each point
};

double distance_to_line(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length = along.norm();
  return length > 0 ? along.cross(p - a).norm() / length : (p - a).norm();
}

}  // namespace

std::vector<Polygon> snap_vertices(const std::vector<Polygon>& polygons,
                                   const std::vector<Cluster>& clusters, const KdTree& tree,
                                   double delta, const SnappingOptions& options) {
  const Snapper snapper(clusters, tree, delta, options);
  std::vector<Polygon> snapped = polygons;
  parallel_for(snapped.size(), [&](std::size_t i) {
    for (Vec3& vertex : snapped[i]) vertex = snapper.snap(vertex, static_cast<int>(i));
    const Polygon hull = convex_hull(snapped[i], clusters[i].fit.plane.normal);
    snapped[i] = hull.size() < 3 ? polygons[i] : hull;  // snapped onto one line: better as it was
  });
  return snapped;
}

std::vector<Polygon> reduce_vertices(std::vector<Polygon> polygons, double delta,
                                     const ReductionOptions& options) {
  const double max_distance = options.max_distance * delta;
  for (Polygon& polygon : polygons) {
    for (std::size_t i = 0; i < polygon.size() && polygon.size() > 3;) {
      const Vec3& before = polygon[(i + polygon.size() - 1) % polygon.size()];
      const Vec3& after = polygon[(i + 1) % polygon.size()];
      if (distance_to_line(polygon[i], before, after) < max_distance)
        polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
      else
        ++i;
    }
  }
  return polygons;
}

}  // namespace scanworld::thesis
