// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/split.h"

#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

// A wall along x, 4 m long, and a partition that meets it in the middle on one side.
Stages partition_stages(double partition) {
  PointCloud cloud;
  Random random(1);
  add_rectangle(cloud, {-2, 0, 0}, {4, 0, 0}, {0, 0, 2}, 0.02, 0.004, random);
  if (partition > 0)
    add_rectangle(cloud, {0.013, 0, 0}, {0, partition, 0}, {0, 0, 2}, 0.02, 0.004, random);
  return run_stages(std::move(cloud), known_scale(0.004, 0.02));
}

std::int32_t wall_or_partition(const Vec3& p) { return p.y() < 0.02 ? 0 : 1; }

Clustering split(const Stages& s, const Clustering& start, const SplitOptions& options = {}) {
  const Clustering c = split_clusters(s.grid, s.neighbors, start, options);
  check_clustering(s.grid, c);
  return c;
}

}  // namespace

TEST_CASE("coplanar walls with a partition between them are two") {
  const Stages s = partition_stages(1.5);
  const Clustering c = split(s, label_sites(s.grid, wall_or_partition));
  CHECK(c.clusters.size() == 3);
  std::int32_t left = kNone, right = kNone;
  for (std::size_t i = 0; i < c.label.size(); ++i) {
    const Vec3 p = s.grid.sites[i].position();
    if (p.y() > 0.1) CHECK(c.label[i] == 1);
    if (p.y() > 0.02 || std::abs(p.x()) < 0.1) continue;
    std::int32_t& side = p.x() < 0 ? left : right;
    if (side == kNone) side = c.label[i];
    CHECK(c.label[i] == side);
  }
  CHECK(left != right);
  CHECK(left != kNone);
  CHECK(right != kNone);
}

TEST_CASE("a wall that nothing known crosses stays one") {
  const Stages alone = partition_stages(0);
  CHECK(split(alone, label_sites(alone.grid, wall_or_partition)).clusters.size() == 1);
  const Stages s = partition_stages(1.5);
  const Clustering c =
      split(s, label_sites(s.grid, [](const Vec3& p) { return p.y() < 0.02 ? 0 : kNone; }));
  CHECK(c.clusters.size() == 1);
}

TEST_CASE("pieces of a cluster that are apart become clusters, small ones go to none") {
  PointCloud cloud;
  Random random(2);
  add_rectangle(cloud, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.02, 0.004, random);
  add_rectangle(cloud, {2, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.02, 0.004, random);
  add_rectangle(cloud, {4, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, 0.02, 0.004, random);
  const Stages s = run_stages(std::move(cloud), known_scale(0.004, 0.02));
  const Clustering c = split(s, label_sites(s.grid, [](const Vec3&) { return 0; }));
  CHECK(c.clusters.size() == 2);
  for (std::size_t i = 0; i < c.label.size(); ++i) {
    const double x = s.grid.sites[i].position().x();
    CHECK(c.label[i] == (x < 1.5 ? 0 : x < 3.5 ? 1 : kNone));
  }
  CHECK(split(s, label_sites(s.grid, [](const Vec3&) { return 0; }), {.min_points = 10})
            .clusters.size() == 3);
}

TEST_CASE("a cluster without any large piece stays as it is") {
  PointCloud cloud;
  Random random(3);
  for (int i = 0; i < 3; ++i)
    add_rectangle(cloud, {0.5 * i, 0, 0}, {0.12, 0, 0}, {0, 0.12, 0}, 0.02, 0.002, random);
  const Stages s = run_stages(std::move(cloud), known_scale(0.002, 0.02));
  const Clustering start = label_sites(s.grid, [](const Vec3&) { return 0; });
  CHECK(split(s, start).label == start.label);
}

TEST_CASE("what changed its cluster is awake") {
  const Stages s = partition_stages(1.5);
  Clustering start = label_sites(s.grid, wall_or_partition);
  std::fill(start.awake.begin(), start.awake.end(), 0);  // all may border still
  const Clustering c = split(s, start);
  CHECK(c.clusters.size() == 3);
  for (std::size_t i = 0; i < c.label.size(); ++i)
    CHECK((c.awake[i] != 0) == (c.label[i] != start.label[i]));
}
