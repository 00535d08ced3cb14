// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rough.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "../polygon.h"
#include "evidence.h"
#include "join.h"

namespace scanworld::rival {

namespace {

// Prices of a site in no cluster and of one in a rough cluster, at most, over that of one which is
// off its plane by noise. They are those of rivalry, and the logarithm of what a Gaussian is wider.
constexpr double kNoPlane = 6, kRoughest = 4;
constexpr double kBeside = 3, kFarBeside = 9;  // [roughness] between which nothing is beside it
constexpr double kMaxRms = 1.35;               // [roughness] of a part, as in merging
constexpr double kParallel = 0.9;              // cosine between normals

// A cluster that may be a rough surface.
struct RoughCandidate {
  std::vector<std::uint32_t> sites;  // ascending
  Cluster cluster;
  std::vector<std::int32_t> parts;  // clusters that would become a part of it

  void add(const Moments& moments) {
    cluster.moments += moments;
    cluster.fit = fit(cluster.moments);
    cluster.roughness = std::sqrt(cluster.fit.variance[0]);
  }
};

// Those with most sites first.
std::vector<RoughCandidate> find_candidates(const Grid& grid, const Leftover& left,
                                            const Grid& coarse, const Clustering& found) {
  std::vector<RoughCandidate> candidates(found.clusters.size());
  for (std::size_t s = 0; s < found.label.size(); ++s)
    if (found.label[s] != kNone)
      for (std::uint32_t place : coarse.points_of(s))
        candidates[static_cast<std::size_t>(found.label[s])].sites.push_back(left.sites[place]);
  for (RoughCandidate& candidate : candidates) {
    std::sort(candidate.sites.begin(), candidate.sites.end());
    Moments sum;
    for (std::uint32_t i : candidate.sites) sum += grid.sites[i].moments();
    if (sum.n > 0) candidate.add(sum);
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const RoughCandidate& a, const RoughCandidate& b) {
              if (a.sites.size() != b.sites.size()) return a.sites.size() > b.sites.size();
              return a.sites < b.sites;
            });
  return candidates;
}

double roughness_price(const Cluster& cluster, const Scale& scale) {
  const double noise = scale.noise_at(cluster.fit.centroid);
  return std::clamp(std::log(cluster.fit.variance[0] / (noise * noise)), 0.0, kRoughest);
}

class RoughTaker {
 public:
  RoughTaker(const Grid& grid, const Neighbors& neighbors, const Scale& scale, Clustering c,
             const Leftover& left, double cell, const RoughOptions& options)
      : grid_(grid),
        neighbors_(neighbors),
        scale_(scale),
        left_(left),
        options_(options),
        cell_(cell),
        members_(members_of(c)),
        c_(std::move(c)) {}

  // If it is a rough surface.
  void take(RoughCandidate candidate) {
    if (area_of(candidate.cluster.fit) < options_.min_area / 2) return;
    const auto explained = static_cast<double>(candidate.sites.size());
    add_parts(candidate);
    if (!is_worth_it(candidate, explained) || !is_surface(candidate)) return;
    const auto label = static_cast<std::int32_t>(c_.clusters.size());
    for (std::uint32_t i : candidate.sites) c_.relabel(i, label);
    for (std::int32_t l : candidate.parts) members_[static_cast<std::size_t>(l)].clear();
    c_.clusters.push_back(candidate.cluster);
    members_.push_back(std::move(candidate.sites));
  }

  Clustering finish() {
    refit(grid_, c_);
    return std::move(c_);
  }

 private:
  const Cluster& at(std::int32_t l) const { return c_.clusters[static_cast<std::size_t>(l)]; }

  // The clusters that lie in a candidate's roughness and touch it. What is much smoother than it,
  // and no small piece, is a thing of its own: a panel, a door.
  void add_parts(RoughCandidate& candidate) const {
    std::set<std::int32_t> beside;
    for (std::uint32_t i : candidate.sites)
      for (std::uint32_t j : neighbors_.of(i))
        if (c_.label[j] != kNone) beside.insert(c_.label[j]);
    for (std::int32_t l : beside) {
      const Cluster &whole = candidate.cluster, &part = at(l);
      const bool is_own =
          std::abs(part.fit.plane.normal.dot(whole.fit.plane.normal)) < kParallel ||
          noise_of(part, scale_.noise_at(part.fit.centroid)) * options_.max_smoother <
              whole.roughness;
      if ((is_own && area_of(part.fit) > options_.small_area) ||
          joint_price(whole, part, scale_, kMaxRms, Meeting::smooth) > 1)
        continue;
      candidate.add(part.moments);
      candidate.parts.push_back(l);
      const std::vector<std::uint32_t>& more = members_[static_cast<std::size_t>(l)];
      candidate.sites.insert(candidate.sites.end(), more.begin(), more.end());
    }
    std::sort(candidate.sites.begin(), candidate.sites.end());
  }

  // Whether what it explains of what is left outweighs what is explained worse by it.
  bool is_worth_it(const RoughCandidate& candidate, double explained) const {
    const double price = roughness_price(candidate.cluster, scale_);
    double gain = explained * (kNoPlane - price);
    for (std::int32_t l : candidate.parts)
      gain -= static_cast<double>(members_[static_cast<std::size_t>(l)].size()) *
              (price - roughness_price(at(l), scale_));
    return gain > 0;
  }

  bool is_surface(const RoughCandidate& candidate) const {
    const MomentFit& f = candidate.cluster.fit;
    const double roughness = candidate.cluster.roughness;
    return roughness >= options_.min_roughness * scale_.noise_at(f.centroid) &&
           area_of(f) >= options_.min_area &&
           std::sqrt(12 * f.variance[1]) >= options_.min_width * roughness &&
           measure_curvature(grid_, candidate.sites, f) < options_.max_curvature &&
           measure_fill(grid_, candidate.sites, f, cell_) > options_.min_fill &&
           count_beside(candidate) <
               options_.max_beside * static_cast<double>(candidate.sites.size());
  }

  // The sites before it that are left, or behind it if these are more. A bush goes on there.
  double count_beside(const RoughCandidate& candidate) const {
    const Plane& plane = candidate.cluster.fit.plane;
    const PlaneFrame frame = frame_of(plane, candidate.cluster.fit.centroid);
    const auto cell_of = [&](const Vec3& p) { return square_of(frame.to_plane(p), cell_); };
    std::set<std::pair<int, int>> cells;
    for (std::uint32_t i : candidate.sites) cells.insert(cell_of(grid_.sites[i].position()));
    double before = 0, behind = 0;
    for (std::uint32_t i : left_.sites) {
      const Vec3 p = grid_.sites[i].position();
      const double d = plane.signed_distance(p) / candidate.cluster.roughness;
      if (std::abs(d) > kBeside && std::abs(d) < kFarBeside && cells.contains(cell_of(p)))
        (d > 0 ? before : behind) += 1;
    }
    return std::max(before, behind);
  }

  const Grid& grid_;
  const Neighbors& neighbors_;
  const Scale& scale_;
  const Leftover& left_;
  const RoughOptions& options_;
  const double cell_;  // [m]
  std::vector<std::vector<std::uint32_t>> members_;
  Clustering c_;
};

}  // namespace

std::vector<double> list_roughness(const Scale& scale, const RoughOptions& options) {
  std::vector<double> list;
  const double least = std::max(options.min_roughness * scale.noise, scale.voxel / 4);
  for (double roughness = options.max_roughness; roughness > least; roughness /= options.step)
    list.push_back(roughness);
  std::reverse(list.begin(), list.end());
  return list;
}

Leftover find_leftover(const Grid& grid, const Neighbors& neighbors, const Clustering& c) {
  Leftover left;
  for (std::size_t i = 0; i < c.label.size(); ++i) {
    if (c.label[i] != kNone || neighbors.of(i).empty()) continue;
    left.places.points.push_back(grid.sites[i].mean);
    left.sites.push_back(static_cast<std::uint32_t>(i));
  }
  return left;
}

Clustering take_rough(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                      Clustering c, const Leftover& left, const Grid& coarse,
                      const Clustering& found, const RoughOptions& options) {
  RoughTaker taker(grid, neighbors, scale, std::move(c), left, coarse.voxel, options);
  for (RoughCandidate& candidate : find_candidates(grid, left, coarse, found))
    taker.take(std::move(candidate));
  return taker.finish();
}

}  // namespace scanworld::rival
