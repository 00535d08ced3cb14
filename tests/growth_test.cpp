// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/growth.h"

#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

TEST_CASE("the faces of a room grow, in six clusters or more that take nearly all sites") {
  for (double noise : {0.003, 0.01, 0.02}) {
    const Stages s = run_stages(room_points({4, 3, 2.5}, 0.03, noise));
    const Clustering c = s.grow();
    check_clustering(s.grid, c);
    CHECK(c.clusters.size() >= 6);
    double taken = 0, all = 0;
    for (const rival::Cluster& k : c.clusters) taken += k.moments.n;
    for (const Site& site : s.grid.sites) all += site.points;
    CHECK(taken > 0.9 * all);
  }
}

TEST_CASE("the members of a cluster are connected and lie near its plane") {
  const Stages s = run_stages(room_points({4, 3, 2.5}, 0.03, 0.005));
  const Clustering c = s.grow();
  std::vector<std::uint8_t> reached(s.grid.sites.size());
  std::vector<int> parts(c.clusters.size());
  std::vector<std::uint32_t> stack;
  for (std::uint32_t start = 0; start < reached.size(); ++start) {
    if (c.label[start] == kNone || reached[start]) continue;
    ++parts[static_cast<std::size_t>(c.label[start])];
    stack.assign(1, start), reached[start] = 1;
    while (!stack.empty()) {
      const std::uint32_t i = stack.back();
      stack.pop_back();
      // Either may be among the other's neighbours; the cube around both holds them.
      s.grid.for_each_near(i, NeighborOptions().max_reach, [&](std::uint32_t j) {
        if (c.label[j] == c.label[i] && !reached[j]) reached[j] = 1, stack.push_back(j);
      });
    }
  }
  for (int n : parts) CHECK(n == 1);
  for (std::size_t i = 0; i < reached.size(); ++i)
    if (c.label[i] != kNone)
      CHECK(std::abs(c.plane(c.label[i]).signed_distance(s.grid.sites[i].position())) <
            4 * s.scale.noise);
}

TEST_CASE("clusters that are there keep their sites, new ones take only what is free") {
  const Stages s = run_stages(room_points({4, 3, 2.5}, 0.03, 0.005));
  const Clustering before =
      label_sites(s.grid, [](const Vec3& p) { return p.z() < 0.03 && p.x() < 2 ? 0 : kNone; });
  const Clustering c = grow_clusters(s.grid, s.neighbors, s.scale, s.local, before);
  check_clustering(s.grid, c);
  CHECK(c.clusters.size() >= 7);
  for (std::size_t i = 0; i < c.label.size(); ++i)
    CHECK((c.label[i] == 0) == (before.label[i] == 0));
}

TEST_CASE("clusters of few points are not kept, and what grew is awake") {
  const Stages s = run_stages(room_points({2, 2, 2}, 0.04, 0.005), known_scale(0.005, 0.04));
  CHECK(grow_clusters(s.grid, s.neighbors, s.scale, s.local, {}, {.min_points = 1000000})
            .clusters.empty());
  for (int least : {20, 500}) {
    const Clustering c =
        grow_clusters(s.grid, s.neighbors, s.scale, s.local, {}, {.min_points = least});
    CHECK(c.clusters.size() >= 6);
    for (const rival::Cluster& k : c.clusters) CHECK(k.moments.n >= least);
  }
  Clustering asleep;
  asleep.awake.assign(s.grid.sites.size(), 0);
  const Clustering c = grow_clusters(s.grid, s.neighbors, s.scale, s.local, asleep);
  for (std::size_t i = 0; i < c.label.size(); ++i)
    if (c.label[i] != kNone) CHECK(c.awake[i]);
}

TEST_CASE("nothing grows where nothing is planar") {
  Random random(1);
  PointCloud cloud;
  for (int i = 0; i < 30000; ++i)
    cloud.points.push_back(
        Vec3(random.uniform(), random.uniform(), random.uniform()).cast<float>());
  const Stages s = run_stages(cloud, known_scale(0.003, 0.02));
  CHECK(s.grow().clusters.empty());
}
