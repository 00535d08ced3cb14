// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "spreading.h"

#include <algorithm>
#include <span>

namespace scanworld::thesis {

namespace {

constexpr int kNobody = -1;

// For each point those in the box around it.
struct Neighbours {
  std::vector<std::size_t>
      first;  // where each point's begin in `all`, and where the last one's end
  std::vector<int> all;

  std::span<const int> of(int point) const {
    const std::size_t i = static_cast<std::size_t>(point);
    return {all.data() + first[i], all.data() + first[i + 1]};
  }
};

Neighbours find_neighbours(const KdTree& tree, double range) {
  Neighbours result{.first = {0}};
  const Vec3 reach = Vec3::Constant(range);
  for (const Vec3& p : tree.points()) {
    tree.range_search(p - reach, p + reach, [&](int q) { result.all.push_back(q); });
    result.first.push_back(result.all.size());
  }
  return result;
}

// Who owns which points, while clusters compete for them.
class Rivalry {
 public:
  Rivalry(const KdTree& tree, double delta, std::vector<Cluster> clusters,
          const SpreadingOptions& options)
      : tree_(tree),
        points_(tree.points()),
        clusters_(std::move(clusters)),
        options_(options),
        reach_(options.spreading_factor * delta),
        min_distance_(options.min_distance * delta),
        neighbours_(find_neighbours(tree, options.outliers_range * delta)),
        owner_(points_.size(), kNobody),
        size_(clusters_.size()) {
    for (std::size_t c = 0; c < clusters_.size(); ++c)
      for (int p : clusters_[c].members) take(static_cast<int>(c), p);
  }

  // Lets each cluster spread once; returns the number of points that changed hands.
  std::size_t round() {
    const std::vector<int> before = owner_;
    for (std::size_t c = 0; c < clusters_.size(); ++c)
      if (size_[c] > 0) spread(static_cast<int>(c));
    std::size_t changes = 0;
    for (std::size_t p = 0; p < owner_.size(); ++p) changes += owner_[p] != before[p];
    return changes;
  }

  // The clusters as they are, with the points that they own.
  std::vector<Cluster> so_far() const {
    std::vector<Cluster> all;
    for (const Cluster& cluster : clusters_) all.push_back({.fit = cluster.fit});
    for (std::size_t p = 0; p < owner_.size(); ++p)
      if (owner_[p] != kNobody)
        all[static_cast<std::size_t>(owner_[p])].members.push_back(static_cast<int>(p));
    return all;
  }

  std::vector<Cluster> result() {
    std::vector<Cluster> left;
    for (std::size_t c = 0; c < clusters_.size(); ++c)
      if (refit(static_cast<int>(c)) &&
          size_[c] >= static_cast<std::size_t>(options_.min_points_in_wall))
        left.push_back(std::move(clusters_[c]));
    std::stable_sort(left.begin(), left.end(), [](const Cluster& a, const Cluster& b) {
      return a.members.size() > b.members.size();
    });
    return left;
  }

 private:
  int& owner(int point) { return owner_[static_cast<std::size_t>(point)]; }
  int owner(int point) const { return owner_[static_cast<std::size_t>(point)]; }
  std::size_t& size(int cluster) { return size_[static_cast<std::size_t>(cluster)]; }
  Cluster& cluster(int index) { return clusters_[static_cast<std::size_t>(index)]; }
  const Vec3& point(int index) const { return points_[static_cast<std::size_t>(index)]; }

  void take(int c, int p) {
    release(p);
    owner(p) = c;
    ++size(c);
  }
  void release(int p) {
    if (owner(p) != kNobody) --size(owner(p));
    owner(p) = kNobody;
  }

  // Brings the cluster's members and plane up to date; where too few points are left, removes it.
  bool refit(int c) {
    std::vector<int>& members = cluster(c).members;
    std::erase_if(members, [&](int p) { return owner(p) != c; });
    const auto fit = members.size() < static_cast<std::size_t>(options_.min_points)
                         ? std::nullopt
                         : fit_plane(points_, members);
    if (fit) {
      cluster(c).fit = *fit;
      return true;
    }
    for (int p : members) release(p);
    members.clear();
    return false;
  }

  bool in_plane(int c, int p) {
    return std::abs(cluster(c).fit.plane.signed_distance(point(p))) < min_distance_;
  }

  void spread(int c) {
    if (!refit(c)) return;
    Vec3 range = Vec3::Zero();
    const Vec3 center = cluster(c).fit.centroid;
    for (int p : cluster(c).members) range = range.cwiseMax((point(p) - center).cwiseAbs());
    range.array() += reach_;
    tree_.range_search(center - range, center + range, [&](int p) {
      const int now = owner(p);
      if (now == c || !in_plane(c, p)) return;
      if (now != kNobody && size(now) >= size(c)) return;
      take(c, p);
      cluster(c).members.push_back(p);
    });
    if (!refit(c)) return;
    for (int p : cluster(c).members)
      if (!in_plane(c, p)) release(p);
    remove_outliers(c);
    refit(c);
  }

  void remove_outliers(int c) {
    std::vector<int> alone;
    for (int p : cluster(c).members) {
      if (owner(p) != c) continue;
      int company = 0;
      for (int q : neighbours_.of(p)) company += owner(q) == c;
      if (company < options_.outliers_min_points) alone.push_back(p);
    }
    for (int p : alone) release(p);
  }

  const KdTree& tree_;
  const std::vector<Vec3>& points_;
  std::vector<Cluster> clusters_;
  const SpreadingOptions& options_;
  const double reach_, min_distance_;
  Neighbours neighbours_;          // of each point, itself included
  std::vector<int> owner_;         // of each point
  std::vector<std::size_t> size_;  // points that each cluster owns
};

}  // namespace

std::vector<Cluster> spread_clusters(const KdTree& tree, double delta,
                                     std::vector<Cluster> clusters, const SpreadingOptions& options,
                                     const SpreadingObserver& observe) {
  Rivalry rivalry(tree, delta, std::move(clusters), options);
  std::size_t most = 0;
  for (int round = 0; round < options.max_rounds; ++round) {
    const std::size_t changes = rivalry.round();
    if (observe) observe(rivalry.so_far());
    most = std::max(most, changes);
    if (static_cast<double>(changes) <= options.stop_share * static_cast<double>(most)) break;
  }
  return rivalry.result();
}

}  // namespace scanworld::thesis
