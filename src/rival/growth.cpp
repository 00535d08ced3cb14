// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "growth.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "../parallel.h"

namespace scanworld::rival {

namespace {

constexpr double kFirstFit = 40, kNextFit = 1.3;  // points with which a plane is fitted anew, and
                                                  // how many times as many for the next time

class Grower {
 public:
  Grower(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
         const std::vector<LocalPlane>& local, Clustering c, const GrowthOptions& options)
      : grid_(grid),
        neighbors_(neighbors),
        scale_(scale),
        local_(local),
        options_(options),
        cos_angle_(static_cast<float>(std::cos(options.max_angle))),
        all_awake_(c.awake.empty()),
        c_(std::move(c)) {
    c_.label.resize(grid.sites.size(), kNone);
    c_.awake.resize(grid.sites.size(), 1);
    c_.border.resize(grid.sites.size(), 1);
  }

  // The free sites that clusters may grow from, the flattest first.
  std::vector<std::uint32_t> find_seeds() const {
    std::vector<std::uint64_t> keys;  // rank << 32 | site; as bits, positive floats are in order
    for (std::size_t i = 0; i < local_.size(); ++i)
      if (c_.label[i] == kNone && local_[i].planar())
        keys.push_back(std::uint64_t{std::bit_cast<std::uint32_t>(local_[i].rank)} << 32 | i);
    parallel_sort(keys);
    return {keys.begin(), keys.end()};  // the lower half of each
  }

  // Adds the cluster that grows from this site, if it is free still and enough comes together.
  void grow(std::uint32_t seed) {
    if (c_.label[seed] != kNone) return;
    start(seed);
    for (std::size_t k = 0; k < members_.size(); ++k) {
      if (k > 0 && !spreads(members_[k])) continue;
      for (std::uint32_t j : neighbors_.of(members_[k]))
        if (c_.label[j] == kNone && fits(j)) take(j);
      if (cluster_.moments.n >= fit_at_) {
        fit_plane();
        fit_at_ = cluster_.moments.n * kNextFit;
      }
    }
    if (cluster_.moments.n < options_.min_points) {
      for (std::uint32_t i : members_) c_.label[i] = kNone;
      return;
    }
    fit_plane();
    c_.clusters.push_back(cluster_);
    if (all_awake_) return;
    for (std::uint32_t i : members_)
      for (std::uint32_t j : neighbors_.of(i)) c_.awake[j] = 1;
  }

  const Clustering& so_far() const { return c_; }
  Clustering take_result() { return std::move(c_); }

 private:
  // With the plane of the free sites around the seed.
  void start(std::uint32_t seed) {
    cluster_ = {};
    for (std::uint32_t j : neighbors_.of(seed))
      if (c_.label[j] == kNone) cluster_.moments += grid_.sites[j].moments();
    fit_plane();
    fit_at_ = kFirstFit;
    cluster_.moments = {};
    members_.clear();
    take(seed);
  }
  void take(std::uint32_t i) {
    c_.label[i] = static_cast<std::int32_t>(c_.clusters.size());
    members_.push_back(i);
    cluster_.moments += grid_.sites[i].moments();
  }
  void fit_plane() {
    cluster_.fit = fit(cluster_.moments);
    bend_ = std::pow(scale_.flatness.bend_at(extent_of(cluster_.fit)), 2);
    normal_ = cluster_.fit.plane.normal.cast<float>();
  }

  // Whether more may be taken from around a site.
  bool spreads(std::uint32_t i) const {
    return local_[i].planar() && std::abs(local_[i].normal.dot(normal_)) > cos_angle_;
  }
  bool fits(std::uint32_t j) const {
    const Site& s = grid_.sites[j];
    const Plane& plane = cluster_.fit.plane;
    const double d = plane.signed_distance(s.position());
    const double variance = scale_.variance_at(s.position()) + bend_;
    const auto limit = [&](double points) {
      return square_off(options_.max_rms, options_.max_distance, points) * variance;
    };
    if (d * d > limit(1) || d * d + s.variance(plane.normal) > limit(s.points)) return false;
    return !local_[j].planar() || std::abs(local_[j].normal.dot(normal_)) >= cos_angle_;
  }

  const Grid& grid_;
  const Neighbors& neighbors_;
  const Scale& scale_;
  const std::vector<LocalPlane>& local_;
  const GrowthOptions& options_;
  const float cos_angle_;
  const bool all_awake_;
  Clustering c_;
  // Of the cluster that grows.
  Cluster cluster_;
  Vec3f normal_ = Vec3f::UnitZ();
  double fit_at_ = 0;
  double bend_ = 0;  // [m2]
  std::vector<std::uint32_t> members_;
};

}  // namespace

Clustering grow_clusters(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                         const std::vector<LocalPlane>& local, Clustering c,
                         const GrowthOptions& options, const Observer& observe) {
  Grower grower(grid, neighbors, scale, local, std::move(c), options);
  std::size_t told_at = 1;  // clusters
  for (std::uint32_t seed : grower.find_seeds()) {
    grower.grow(seed);
    const Clustering& so_far = grower.so_far();
    if (!observe || so_far.clusters.size() < told_at) continue;
    observe("clusters grow, from the flattest places first", so_far);
    told_at = 2 * so_far.clusters.size();
  }
  if (observe) observe("all clusters have grown", grower.so_far());
  return grower.take_result();
}

}  // namespace scanworld::rival
