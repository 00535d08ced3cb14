// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "stages.h"

#include <algorithm>

namespace scanworld::test {

using namespace rival;

Stages run_stages(PointCloud cloud, const RivalOptions& options, bool part) {
  Stages s{.cloud = std::move(cloud), .options = options};
  s.scale = estimate_scale(s.cloud, options.scale);
  s.grid = build_grid(s.cloud, s.scale.voxel);
  s.neighbors = find_neighbors(s.grid, options.neighbors);
  s.local = fit_locally(s.grid, s.neighbors, s.scale, options.local);
  if (!part) return s;
  s.grid = part_sides(s.cloud, std::move(s.grid), s.neighbors, s.local, s.scale, options.sides);
  std::vector<std::uint8_t> changed;
  s.neighbors = update_neighbors(s.grid, options.neighbors, std::move(s.neighbors), changed);
  s.local = fit_locally(s.grid, s.neighbors, s.scale, options.local, std::move(s.local), changed);
  return s;
}

Clustering Stages::grow() const {
  return grow_clusters(grid, neighbors, scale, local, {}, options.growth);
}

Clustering Stages::settle() const {
  std::vector<LocalPlane> changed = local;
  return rival::settle(grid, neighbors, scale, changed, grow(), options);
}

Clustering Stages::confirm() const {
  std::vector<LocalPlane> changed = local;
  Clustering c = rival::settle(grid, neighbors, scale, changed, grow(), options);
  c = part(grid, neighbors, scale, changed, std::move(c), options);
  return rival::confirm(grid, neighbors, scale, changed, std::move(c), options);
}

RivalOptions known_scale(double noise, double spacing) {
  RivalOptions options;
  options.scale.noise = noise;
  options.scale.spacing = spacing;
  options.scale.voxel = std::max({0.04, 1.4 * spacing, 3 * noise});
  return options;
}

Clustering label_sites(const Grid& grid, const std::function<std::int32_t(const Vec3&)>& label_of) {
  Clustering c;
  for (const Site& site : grid.sites) {
    const std::int32_t l = label_of(site.position());
    c.label.push_back(l);
    if (l == kNone) continue;
    if (c.clusters.size() <= static_cast<std::size_t>(l))
      c.clusters.resize(static_cast<std::size_t>(l) + 1);
    c.clusters[static_cast<std::size_t>(l)].moments += site.moments();
  }
  for (Cluster& k : c.clusters) {
    REQUIRE(k.moments.n >= kMinPoints);
    k.fit = fit(k.moments);
  }
  c.border.assign(grid.sites.size(), 1);
  c.awake.assign(grid.sites.size(), 1);
  return c;
}

void check_clustering(const Grid& grid, const Clustering& c) {
  REQUIRE(c.label.size() == grid.sites.size());
  CHECK(c.border.size() == grid.sites.size());
  CHECK(c.awake.size() == grid.sites.size());
  std::vector<Moments> sums(c.clusters.size());
  for (std::size_t i = 0; i < c.label.size(); ++i) {
    REQUIRE(c.label[i] >= kNone);
    REQUIRE(c.label[i] < static_cast<std::int32_t>(c.clusters.size()));
    if (c.label[i] != kNone) sums[static_cast<std::size_t>(c.label[i])] += grid.sites[i].moments();
  }
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const Moments &m = c.clusters[k].moments, &sum = sums[k];
    CHECK(m.n == sum.n);
    REQUIRE(sum.n > 0);
    CHECK((m.mean() - sum.mean()).norm() < 1e-9);
    CHECK((m.covariance() - sum.covariance()).norm() < 1e-9);
    CHECK((c.clusters[k].fit.centroid - sum.mean()).norm() < 1e-9);
    CHECK(std::abs(sum.mean_square(c.clusters[k].fit.plane) - c.clusters[k].fit.variance[0]) <
          1e-9);
  }
}

std::vector<std::size_t> site_counts(const Clustering& c) {
  std::vector<std::size_t> counts(c.clusters.size());
  for (std::int32_t l : c.label)
    if (l != kNone) ++counts[static_cast<std::size_t>(l)];
  return counts;
}

}  // namespace scanworld::test
