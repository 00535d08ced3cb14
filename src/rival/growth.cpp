// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "growth.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "../parallel.h"

namespace scanworld::rival {

Clustering grow_clusters(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                         const std::vector<LocalPlane>& local, Clustering c,
                         const GrowthOptions& options) {
  c.label.resize(grid.sites.size(), kNone);
  c.awake.resize(grid.sites.size(), 1);
  c.border.resize(grid.sites.size(), 1);
  std::vector<std::uint64_t> seeds;  // rank << 32 | site; as bits, positive floats are in order
  for (std::size_t i = 0; i < grid.sites.size(); ++i)
    if (c.label[i] == kNone && local[i].planar())
      seeds.push_back(std::uint64_t{std::bit_cast<std::uint32_t>(local[i].rank)} << 32 | i);
  parallel_sort(seeds);

  const double many = options.max_rms * options.max_rms;
  const double one = options.max_distance * options.max_distance - many;
  const float cos_angle = static_cast<float>(std::cos(options.max_angle));
  std::vector<std::uint32_t> members;
  for (const std::uint64_t key : seeds) {
    const auto seed = static_cast<std::uint32_t>(key);
    if (c.label[seed] != kNone) continue;
    const auto id = static_cast<std::int32_t>(c.clusters.size());
    Cluster cluster;
    for (std::uint32_t j : neighbors.of(seed))
      if (c.label[j] == kNone) cluster.moments += grid.sites[j].moments();
    cluster.fit = fit(cluster.moments);
    cluster.moments = grid.sites[seed].moments();
    members.assign(1, seed);
    c.label[seed] = id;
    double refit_at = 40;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const std::size_t i = members[k];
      const Vec3f normal = cluster.fit.plane.normal.cast<float>();
      if (k > 0 && !(local[i].planar() && std::abs(local[i].normal.dot(normal)) > cos_angle))
        continue;
      for (std::uint32_t j : neighbors.of(i)) {
        if (c.label[j] != kNone) continue;
        const Site& s = grid.sites[j];
        const double d = cluster.fit.plane.signed_distance(s.position());
        const double variance = scale.variance_at(s.position());
        if (d * d > (many + one) * variance) continue;
        if (d * d + s.variance(cluster.fit.plane.normal) > (many + one / s.points) * variance)
          continue;
        if (local[j].planar() && std::abs(local[j].normal.dot(normal)) < cos_angle) continue;
        c.label[j] = id;
        members.push_back(j);
        cluster.moments += s.moments();
      }
      if (cluster.moments.n >= refit_at) {
        cluster.fit = fit(cluster.moments);
        refit_at = cluster.moments.n * 1.3;
      }
    }
    if (cluster.moments.n < options.min_points) {
      for (std::uint32_t i : members) c.label[i] = kNone;
      continue;
    }
    for (std::uint32_t i : members)
      for (std::uint32_t j : neighbors.of(i)) c.awake[j] = 1;
    cluster.fit = fit(cluster.moments);
    c.clusters.push_back(cluster);
  }
  return c;
}

}  // namespace scanworld::rival
