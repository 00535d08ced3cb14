// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "evidence.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "../parallel.h"
#include "../polygon.h"

namespace scanworld::rival {

namespace {

constexpr double kSure = std::numeric_limits<double>::infinity();  // odds of what is not weighed

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

// The share that a cluster has of the points around its sites that are in no larger one. Strays all
// over a place lie in some plane too, but most of them lie beside it.
double measure_purity(const Grid& grid, const Neighbors& neighbors, const Clustering& c,
                      const std::vector<std::uint32_t>& sites, std::size_t k) {
  double own = 0, free = 0;
  for (const std::uint32_t i : sites)
    for (const std::uint32_t j : neighbors.of(i)) {
      if (c.label[j] == static_cast<std::int32_t>(k)) own += grid.sites[j].points;
      if (c.label[j] == kNone) free += grid.sites[j].points;
    }
  return own / std::max(1.0, own + free);
}

bool is_too_small(const Cluster& cluster, std::size_t sites, const Scale& scale,
                  const EvidenceOptions& options) {
  const double n = cluster.moments.n, area = area_of(cluster.fit);
  if (n < options.min_points) return true;
  // Noise spreads a plane's points over more than one voxel.
  const double seen = 0.6 * static_cast<double>(sites) * scale.voxel * scale.voxel;
  const double noise = scale.noise_at(cluster.fit.centroid);
  if (seen < options.min_area || area < std::pow(options.area_noise * noise, 2)) return true;
  return std::sqrt(12 * cluster.fit.variance[1]) < options.min_width * scale.voxel;
}

// Whether a cluster has few points for its area.
bool is_sparse(const Cluster& cluster, const Scale& scale, const EvidenceOptions& options) {
  return cluster.moments.n < options.sparse_points &&
         cluster.moments.n * scale.spacing * scale.spacing <
             options.min_density * area_of(cluster.fit);
}

// The square of what the points of a cluster are off its plane where it is as flat as the scan's
// surfaces are [m2].
double expected_square(const Cluster& cluster, const Scale& scale) {
  return scale.variance_at(cluster.fit.centroid) +
         std::pow(scale.flatness.bend_at(extent_of(cluster.fit)), 2);
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

// The share of a cluster's sites that are beside those of other clusters.
double measure_contact(const Neighbors& neighbors, const Clustering& c,
                       const std::vector<std::uint32_t>& sites) {
  const auto touches = [&](std::uint32_t i) {
    return std::ranges::any_of(neighbors.of(i), [&](std::uint32_t j) {
      return c.label[j] != kNone && c.label[j] != c.label[i];
    });
  };
  return static_cast<double>(std::ranges::count_if(sites, touches)) /
         static_cast<double>(sites.size());
}

Traits find_traits(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                   const Clustering& c, const std::vector<std::uint32_t>& sites, std::size_t k,
                   double explained) {
  const Cluster& cluster = c.clusters[k];
  const double n = cluster.moments.n, area = area_of(cluster.fit);
  return {.roughness = std::sqrt(cluster.fit.variance[0] / expected_square(cluster, scale)),
          .curvature = measure_curvature(grid, sites, cluster.fit),
          .contact = measure_contact(neighbors, c, sites),
          .explained = explained / n,
          .area = area,
          .density = n * scale.spacing * scale.spacing / area,
          .fill = measure_fill(grid, sites, cluster.fit, grid.voxel)};
}

// What all odds are to be multiplied by, as a logarithm, where the share of planes in this scan is
// another than in those that the odds were fitted to: found by expectation and maximization.
double find_prior(const std::vector<double>& odds, const EvidenceOptions& options) {
  constexpr double kFitted = 0.377;  // the share of planes there
  constexpr double kBelief = 20;  // clusters that speak for it, so that few in the scan say little
  constexpr int kRounds = 30;
  const auto logit = [](double p) { return std::log(p / (1 - p)); };
  double shift = 0;
  for (int round = 0; round < kRounds; ++round) {
    double planes = kFitted * kBelief, all = kBelief;
    for (double odd : odds) planes += 1 / (1 + std::exp(-odd - shift)), all += 1;
    shift = logit(std::clamp(planes / all, 0.02, 0.98)) - logit(kFitted);
  }
  return std::clamp(options.prior_share * shift, -options.max_prior, options.max_prior);
}

// Takes all sites from the clusters that are marked.
void drop_clusters(const std::vector<char>& marked, Clustering& c) {
  for (std::size_t i = 0; i < c.label.size(); ++i)
    if (c.label[i] != kNone && marked[static_cast<std::size_t>(c.label[i])]) c.relabel(i, kNone);
}

}  // namespace

double measure_curvature(const Grid& grid, const std::vector<std::uint32_t>& sites,
                         const MomentFit& f) {
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
  return left > 0 && explained > 0 ? explained / left - 3 / n : 0;
}

double measure_fill(const Grid& grid, const std::vector<std::uint32_t>& sites, const MomentFit& f,
                    double cell) {
  constexpr int kTurns = 45;  // of two degrees
  const PlaneFrame frame = frame_of(f.plane, f.centroid);
  std::vector<Vec2> at;
  std::set<std::pair<int, int>> cells;
  for (std::uint32_t i : sites) {
    at.push_back(frame.to_plane(grid.sites[i].position()));
    cells.insert(square_of(at.back(), cell));
  }
  double smallest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kTurns; ++k) {
    const Eigen::Rotation2Dd turn(k * M_PI / (2 * kTurns));
    Eigen::AlignedBox2d box;
    for (const Vec2& p : at) box.extend(turn * p);
    smallest = std::min(smallest, (box.sizes().array() + cell).prod());
  }
  return static_cast<double>(cells.size()) * cell * cell / smallest;
}

double log_odds(const Traits& t) {
  const auto log_of = [](double x, double low, double high) {
    return std::log(std::clamp(x, low, high));
  };
  // Fitted to 11,000 clusters of made scenes with their truth (docs/method.md).
  return 5.76 - 4.1 * std::clamp(t.roughness, 0.3, 2.0) - 6.13 * std::clamp(t.curvature, 0.0, 0.6) -
         2.38 * t.contact - 2.15 * t.explained + 0.79 * log_of(t.area, 0.005, 2) -
         0.65 * log_of(t.density, 0.1, 10) + 3.12 * t.fill;
}

Clustering weigh_evidence(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                          Clustering c, const EvidenceOptions& options) {
  const std::vector<std::vector<std::uint32_t>> members = members_of(c);
  const std::vector<double> explained = count_explained(grid, neighbors, scale, c, options);
  std::vector<char> drop(c.clusters.size());
  std::vector<double> odds(c.clusters.size(), kSure);
  parallel_for(c.clusters.size(), [&](std::size_t k) {
    const Cluster& cluster = c.clusters[k];
    drop[k] = is_too_small(cluster, members[k].size(), scale, options) ||
              explained[k] > options.explained_share * cluster.moments.n ||
              (is_sparse(cluster, scale, options) &&
               (cluster.moments.n < options.min_sparse_points ||
                measure_purity(grid, neighbors, c, members[k], k) < options.min_purity ||
                measure_curvature(grid, members[k], cluster.fit) > options.max_curvature));
    if (!drop[k] && area_of(cluster.fit) < options.small_area)
      odds[k] = log_odds(find_traits(grid, neighbors, scale, c, members[k], k, explained[k]));
  });
  std::vector<double> weighed;
  for (double odd : odds)
    if (odd != kSure) weighed.push_back(odd);
  const double prior = find_prior(weighed, options);
  for (std::size_t k = 0; k < drop.size(); ++k) drop[k] |= odds[k] + prior < options.min_log_odds;
  drop_clusters(drop, c);
  return c;
}

}  // namespace scanworld::rival
