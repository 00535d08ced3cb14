// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "thesis/spreading.h"

#include <set>

#include "support/scenes.h"
#include "thesis/filter.h"
#include "thesis/placing.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::thesis;

namespace {

struct Found {
  FilteredPoints filtered;
  std::vector<thesis::Cluster> walls;
};

Found find_walls(const PointCloud& cloud, const SpreadingOptions& options = {},
                 const FilterOptions& filter = {}) {
  Found found{.filtered = filter_points(cloud, filter)};
  const KdTree tree(found.filtered.points);
  found.walls = spread_clusters(tree, found.filtered.delta,
                                place_clusters(tree, found.filtered.delta), options);
  return found;
}

}  // namespace

TEST_CASE("a room has six walls, one cluster each, the largest first") {
  for (std::uint64_t seed : {1u, 2u, 3u}) {
    const Found found = find_walls(room_points({5, 4, 2.7}, 0.03, 0.005, seed));
    REQUIRE(found.walls.size() == 6);
    std::set<int> taken;
    for (std::size_t i = 0; i < 6; ++i) {
      if (i > 0) CHECK(found.walls[i - 1].members.size() >= found.walls[i].members.size());
      for (int p : found.walls[i].members) CHECK(taken.insert(p).second);
      CHECK(found.walls[i].fit.plane.normal.maxCoeff() > 0.999);
    }
    CHECK(static_cast<double>(taken.size()) >
          0.95 * static_cast<double>(found.filtered.points.size()));
  }
}

TEST_CASE(
    "two walls in one plane stay apart at a reach of five delta and are united with a far larger "
    "one") {
  PointCloud cloud;
  Random random(1);
  add_rectangle(cloud, {0, 0, 0}, {2, 0, 0}, {0, 0, 2}, 0.02, 0.003, random);
  add_rectangle(cloud, {3.5, 0, 0}, {2, 0, 0}, {0, 0, 2}, 0.02, 0.003, random);
  CHECK(find_walls(cloud).walls.size() == 2);
  CHECK(find_walls(cloud, {.spreading_factor = 40}).walls.size() == 1);
}

TEST_CASE("too small a reach leaves a wall in pieces") {
  const PointCloud cloud = room_points({5, 4, 2.7}, 0.03, 0.005);
  CHECK(find_walls(cloud, {.spreading_factor = 0}).walls.size() > 6);
}

TEST_CASE("points beside a wall's plane, and lone ones in it, do not belong to it") {
  PointCloud cloud;
  Random random(2);
  add_rectangle(cloud, {0, 0, 0}, {3, 0, 0}, {0, 3, 0}, 0.02, 0.002, random);
  const std::size_t wall_points = cloud.points.size();
  for (int i = 0; i < 300; ++i)
    cloud.points.push_back(
        Vec3(random.uniform(0, 3), random.uniform(0, 3), random.uniform(0.2, 2)).cast<float>());
  for (int i = 0; i < 3; ++i) cloud.points.push_back(Vec3f(3.3f, 3.3f, 0));
  const Found found = find_walls(cloud);
  REQUIRE(found.walls.size() == 1);
  for (std::size_t i = wall_points; i < cloud.points.size(); ++i) {
    const int median = found.filtered.from_input[i];
    if (median < 0 || found.filtered.points[static_cast<std::size_t>(median)].z() < 0.1) continue;
    CHECK(std::find(found.walls[0].members.begin(), found.walls[0].members.end(), median) ==
          found.walls[0].members.end());
  }
}

TEST_CASE("spreading ends after the rounds allowed, and without clusters at once") {
  const FilteredPoints filtered = filter_points(room_points({5, 4, 2.7}, 0.03, 0.005));
  const KdTree tree(filtered.points);
  CHECK(spread_clusters(tree, filtered.delta, {}).empty());
  const auto clusters = place_clusters(tree, filtered.delta);
  CHECK(
      spread_clusters(tree, filtered.delta, clusters, {.stop_share = 0, .max_rounds = 1}).size() >=
      6);
}
