// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "evidence.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "../parallel.h"

namespace scanworld::rival {

namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

// How much of the points' variance off the plane a quadratic surface explains.
struct Bend {
  double share = 0, rms = 0;
};

Bend measure_bend(const Grid& grid, const std::vector<std::uint32_t>& sites, const MomentFit& f) {
  const PlaneFrame frame = frame_of(f.plane, f.centroid);
  const double unit = std::sqrt(f.variance[2]) + 1e-9;
  Mat6 a = Mat6::Zero();
  Vec6 b = Vec6::Zero();
  double total = 0, n = 0;
  for (std::uint32_t i : sites) {
    const Site& s = grid.sites[i];
    const Vec2 q = frame.to_plane(s.position()) / unit;
    const double h = f.plane.signed_distance(s.position()), w = s.points;
    Vec6 row;
    row << 1, q.x(), q.y(), q.x() * q.x(), q.x() * q.y(), q.y() * q.y();
    a += w * row * row.transpose();
    b += w * h * row;
    total += w * (h * h + std::max(0.0, s.variance(f.plane.normal)));
    n += w;
  }
  // Against the plane fitted the same way, so that only the bend counts.
  const Vec6 quadric = a.ldlt().solve(b);
  const Vec3 plane = a.topLeftCorner<3, 3>().ldlt().solve(b.head<3>());
  const double explained = quadric.dot(b) - plane.dot(b.head<3>());
  const double left = total - plane.dot(b.head<3>());
  if (!(left > 0) || !(explained > 0)) return {};
  return {explained / left - 3 / n, std::sqrt(explained / n)};
}

double area_of(const Cluster& cluster) {
  return 12 * std::sqrt(cluster.fit.variance[1] * cluster.fit.variance[2]);
}

bool is_too_small(const Cluster& cluster, std::size_t sites, const Scale& scale,
                  const EvidenceOptions& options) {
  const double n = cluster.moments.n, area = area_of(cluster);
  if (n < options.min_points) return true;
  // Noise spreads a plane's points over more than one voxel.
  const double seen = 0.6 * static_cast<double>(sites) * scale.voxel * scale.voxel;
  const double noise = scale.noise_at(cluster.fit.centroid);
  if (seen < options.min_area || area < std::pow(options.area_noise * noise, 2)) return true;
  if (std::sqrt(12 * cluster.fit.variance[1]) <
      std::max(options.min_width * scale.voxel, options.min_breadth))
    return true;
  return n < options.sparse_points &&
         n * scale.spacing * scale.spacing < options.min_density * area;
}

// The square of what the points of a cluster are off its plane where it is as flat as the scan's
// surfaces are [m2].
double expected_square(const Cluster& cluster, const Scale& scale) {
  return scale.variance_at(cluster.fit.centroid) +
         std::pow(scale.flatness.bend_at(extent_of(cluster.fit)), 2);
}

// What is soft or ragged: leaves, cushions, cables.
bool is_rough(const Cluster& cluster, const Scale& scale, const EvidenceOptions& options) {
  return area_of(cluster) <= options.small_area &&
         cluster.fit.variance[0] >
             options.max_roughness * options.max_roughness * expected_square(cluster, scale);
}

bool is_bent(const Grid& grid, const std::vector<std::uint32_t>& sites, const Cluster& cluster,
             const Scale& scale, const EvidenceOptions& options) {
  if (area_of(cluster) > options.small_area) return false;
  const Bend bend = measure_bend(grid, sites, cluster.fit);
  // A parabola over a length l has the rms k l^2 / (8 * 3.35).
  const double square_length = 12 * cluster.fit.variance[2];
  const double curvature = 8 * 3.35 * bend.rms / square_length;
  return (curvature > options.min_curvature || bend.rms > options.high_bend) &&
         bend.share > options.bend_share + options.bend_chance / cluster.moments.n &&
         bend.rms > options.bend_height * std::sqrt(expected_square(cluster, scale));
}

// For each cluster, how many of its points larger ones that are next to them explain as well.
std::vector<double> count_explained(const Grid& grid, const Neighbors& neighbors,
                                    const Scale& scale, const Clustering& c,
                                    const EvidenceOptions& options) {
  const double max_square = options.explained_distance * options.explained_distance;
  const std::vector<double> bends = square_bends(c, scale);
  std::vector<double> explained(c.clusters.size());
  const auto points = [&](std::int32_t l) {
    return c.clusters[static_cast<std::size_t>(l)].moments.n;
  };
  for (std::size_t i = 0; i < c.label.size(); ++i) {
    const std::int32_t own = c.label[i];
    if (own == kNone || !c.may_border(i)) continue;
    const Site& s = grid.sites[i];
    for (std::uint32_t j : neighbors.of(i)) {
      const std::int32_t l = c.label[j];
      if (l == kNone || l == own || points(l) <= points(own)) continue;
      const Plane& plane = c.plane(l);
      if (std::pow(plane.signed_distance(s.position()), 2) + s.variance(plane.normal) >
          max_square * (scale.variance_at(s.position()) + bends[static_cast<std::size_t>(l)]))
        continue;
      explained[static_cast<std::size_t>(own)] += s.points;
      break;
    }
  }
  return explained;
}

// For each cluster, how many points in no cluster are next to its own.
std::vector<double> count_around(const Grid& grid, const Neighbors& neighbors,
                                 const Clustering& c) {
  std::vector<double> around(c.clusters.size());
  std::vector<std::int32_t> seen;
  for (std::size_t i = 0; i < c.label.size(); ++i) {
    if (c.label[i] != kNone || !c.may_border(i)) continue;
    seen.clear();
    for (std::uint32_t j : neighbors.of(i)) {
      const std::int32_t l = c.label[j];
      if (l != kNone && add_new(seen, l))
        around[static_cast<std::size_t>(l)] += grid.sites[i].points;
    }
  }
  return around;
}

// Takes all sites from the clusters that are marked; tells whether any had some.
bool drop_clusters(const std::vector<char>& marked, Clustering& c) {
  bool any = false;
  for (std::size_t i = 0; i < c.label.size(); ++i)
    if (c.label[i] != kNone && marked[static_cast<std::size_t>(c.label[i])])
      c.relabel(i, kNone), any = true;
  return any;
}

}  // namespace

Clustering weigh_evidence(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                          Clustering c, const EvidenceOptions& options) {
  const std::vector<std::vector<std::uint32_t>> members = members_of(c);
  std::vector<char> drop(c.clusters.size());
  const std::vector<double> explained = count_explained(grid, neighbors, scale, c, options);
  parallel_for(c.clusters.size(), [&](std::size_t k) {
    const Cluster& cluster = c.clusters[k];
    drop[k] = is_too_small(cluster, members[k].size(), scale, options) ||
              is_rough(cluster, scale, options) ||
              explained[k] > options.explained_share * cluster.moments.n ||
              is_bent(grid, members[k], cluster, scale, options);
  });
  drop_clusters(drop, c);
  // What goes on past its border as something else than a plane is a piece of something round. When
  // one piece is gone, those next to it show.
  for (int round = 0; round < options.surrounded_rounds; ++round) {
    const std::vector<double> around = count_around(grid, neighbors, c);
    for (std::size_t k = 0; k < drop.size(); ++k)
      drop[k] = area_of(c.clusters[k]) <= options.surrounded_area &&
                around[k] > options.surrounded * c.clusters[k].moments.n;
    if (!drop_clusters(drop, c)) break;
  }
  return c;
}

}  // namespace scanworld::rival
