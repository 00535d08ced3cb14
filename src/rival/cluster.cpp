// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "cluster.h"

#include <algorithm>

#include "../parallel.h"

namespace scanworld::rival {

namespace {

// What the sites of each cluster add up to.
std::vector<Moments> sum_moments(const Grid& grid, const Clustering& c) {
  const std::size_t parts = part_count(grid.sites.size(), kSitesPerPart);
  std::vector<std::vector<std::pair<std::int32_t, Moments>>> found(parts);
  parallel_for(parts, [&](std::size_t part) {
    const auto [begin, end] = part_of(part, grid.sites.size(), kSitesPerPart);
    auto& list = found[part];
    std::size_t at = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const std::int32_t l = c.label[i];
      if (l == kNone) continue;
      if (at >= list.size() || list[at].first != l) {
        at = static_cast<std::size_t>(
            std::find_if(list.begin(), list.end(), [&](const auto& k) { return k.first == l; }) -
            list.begin());
        if (at == list.size()) list.push_back({l, {}});
      }
      list[at].second += grid.sites[i].moments();
    }
  });
  std::vector<Moments> sums(c.clusters.size());
  for (const auto& list : found)
    for (const auto& [l, m] : list) sums[static_cast<std::size_t>(l)] += m;
  return sums;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> members_of(const Clustering& c) {
  std::vector<std::vector<std::uint32_t>> members(c.clusters.size());
  for (std::size_t i = 0; i < c.label.size(); ++i)
    if (c.label[i] != kNone)
      members[static_cast<std::size_t>(c.label[i])].push_back(static_cast<std::uint32_t>(i));
  return members;
}

double square_bend(const MomentFit& fit, const Scale& scale) {
  const double extent = extent_of(fit);
  const double own = fit.variance[0] - scale.variance_at(fit.centroid);
  return std::clamp(own, std::pow(scale.flatness.bend_at(extent), 2),
                    std::pow(scale.flatness.limit_at(extent), 2));
}

std::vector<double> square_bends(const Clustering& c, const Scale& scale) {
  std::vector<double> bends;
  for (const Cluster& cluster : c.clusters)
    bends.push_back(
        std::max(square_bend(cluster.fit, scale), cluster.roughness * cluster.roughness));
  return bends;
}

void refit(const Grid& grid, Clustering& c) {
  const std::vector<Moments> sums = sum_moments(grid, c);
  std::vector<std::int32_t> to(c.clusters.size(), kNone);
  std::vector<Cluster> kept;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (sums[k].n < kMinPoints) continue;
    to[k] = static_cast<std::int32_t>(kept.size());
    kept.push_back({sums[k], fit(sums[k]), c.clusters[k].roughness});
  }
  c.clusters = std::move(kept);
  for (std::int32_t& l : c.label)
    if (l != kNone) l = to[static_cast<std::size_t>(l)];
}

}  // namespace scanworld::rival
