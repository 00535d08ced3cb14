// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/neighbors.h"

#include <algorithm>

#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

// Points of very different density, over many blocks.
PointCloud uneven_points() {
  Random random(1);
  PointCloud cloud;
  add_rectangle(cloud, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, 0.02, 0.003, random);
  add_rectangle(cloud, {-2, -2, 0}, {0, 4, 0}, {0, 0, 2}, 0.08, 0.003, random);
  for (int i = 0; i < 1000; ++i)
    cloud.points.push_back(
        Vec3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(0, 2)).cast<float>());
  return cloud;
}

std::vector<std::uint32_t> sorted(std::span<const std::uint32_t> list) {
  std::vector<std::uint32_t> result(list.begin(), list.end());
  std::sort(result.begin(), result.end());
  return result;
}

// A room with a thin wall in it, its sides parted.
Stages thin_wall_stages() {
  PointCloud cloud = room_points({3, 3, 2.5}, 0.03, 0.003);
  Random random(2);
  add_rectangle(cloud, {1.5, 0, 0}, {0, 1.5, 0}, {0, 0, 2.5}, 0.02, 0.003, random);
  add_rectangle(cloud, {1.53, 0, 0}, {0, 1.5, 0}, {0, 0, 2.5}, 0.02, 0.003, random);
  return run_stages(std::move(cloud), known_scale(0.003, 0.03));
}

}  // namespace

TEST_CASE("a site's neighbours are all of the smallest cube that holds points and sites enough") {
  const Grid grid = build_grid(uneven_points(), 0.05);
  REQUIRE(grid.sites.size() > Neighbors::kPart);
  const NeighborOptions options{.min_points = 15, .min_sites = 10, .max_reach = 4};
  const Neighbors neighbors = find_neighbors(grid, options);
  int at_reach[5] = {};
  for (std::size_t i = 0; i < grid.sites.size(); ++i) {
    std::vector<std::uint32_t> expected;
    std::uint32_t points = 0;
    int reach = 0;
    while (reach < 4 && (points < 15 || expected.size() < 10)) {
      expected.clear(), points = 0, ++reach;
      grid.for_each_near(i, reach, [&](std::uint32_t k) {
        expected.push_back(k), points += grid.sites[k].points;
      });
    }
    ++at_reach[reach];
    std::sort(expected.begin(), expected.end());
    const auto found = sorted(neighbors.of(i));
    CHECK(found == expected);
    CHECK(std::binary_search(found.begin(), found.end(), i));
  }
  for (int reach = 1; reach <= 4; ++reach) CHECK(at_reach[reach] > 0);
  std::size_t sum = 0;
  for (std::size_t i = 0; i < grid.sites.size(); ++i) sum += neighbors.of(i).size();
  CHECK(count_of(neighbors) == sum);
}

TEST_CASE("a single ring of a lidar is no neighbourhood: it reaches for the next one") {
  PointCloud cloud;
  const double apart = 0.15;
  for (int ring = 0; ring < 5; ++ring)
    for (int i = 0; i < 400; ++i)
      cloud.points.push_back(Vec3(0.005 * i, apart * ring, 0).cast<float>());
  const Grid grid = build_grid(cloud, 0.04);
  const Neighbors neighbors = find_neighbors(grid, {.max_reach = 8});
  for (std::size_t i = 0; i < grid.sites.size(); ++i) {
    double low = 10, high = -10;
    for (const std::uint32_t j : neighbors.of(i)) {
      low = std::min(low, grid.sites[j].position().y());
      high = std::max(high, grid.sites[j].position().y());
    }
    CHECK(high - low > 0.9 * apart);
  }
}

TEST_CASE("sites that a mask leaves out have no neighbours and are none") {
  const Grid grid = build_grid(uneven_points(), 0.05);
  Random random(3);
  std::vector<std::uint8_t> only(grid.sites.size());
  for (auto& o : only) o = random.whole(0, 2) == 0;
  const Neighbors neighbors = find_neighbors(grid, {}, only);
  for (std::size_t i = 0; i < grid.sites.size(); ++i) {
    const auto list = sorted(neighbors.of(i));
    CHECK(std::binary_search(list.begin(), list.end(), i) == (only[i] != 0));
    if (!only[i]) CHECK(list.empty());
    for (std::uint32_t k : list) CHECK(only[k]);
  }
  const std::vector<std::uint8_t> all(grid.sites.size(), 1);
  const Neighbors with_all = find_neighbors(grid, {}, all), without = find_neighbors(grid);
  for (std::size_t i = 0; i < grid.sites.size(); ++i)
    CHECK(sorted(with_all.of(i)) == sorted(without.of(i)));
}

TEST_CASE("where two sides were parted, neighbours are on the own side") {
  const Stages s = thin_wall_stages();
  std::size_t parted = 0;
  REQUIRE(!s.grid.separators.empty());
  for (std::size_t i = 0; i < s.grid.sites.size(); ++i) {
    const auto list = sorted(s.neighbors.of(i));
    CHECK(std::binary_search(list.begin(), list.end(), i));
    CHECK(std::adjacent_find(list.begin(), list.end()) == list.end());
    if (s.grid.separator[i] < 0) continue;
    const Plane& between = s.grid.separators[static_cast<std::size_t>(s.grid.separator[i])];
    const bool side = between.signed_distance(s.grid.sites[i].position()) > 0;
    for (std::uint32_t k : list)
      CHECK((between.signed_distance(s.grid.sites[k].position()) > 0) == side);
    ++parted;
  }
  CHECK(parted > 500);
}

TEST_CASE("neighbours that were updated are those that would be found anew, changes are marked") {
  const Stages s = thin_wall_stages();
  REQUIRE(!s.grid.separators.empty());
  REQUIRE(s.grid.sites.size() > 2 * Neighbors::kPart);
  const Grid whole = build_grid(s.cloud, s.scale.voxel);
  const Neighbors before = find_neighbors(whole);
  std::vector<std::uint8_t> changed;
  const Neighbors updated = update_neighbors(s.grid, {}, before, changed);
  const Neighbors anew = find_neighbors(s.grid);
  REQUIRE(changed.size() == s.grid.sites.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < s.grid.sites.size(); ++i) {
    const auto list = sorted(anew.of(i));
    CHECK(sorted(updated.of(i)) == list);
    if (changed[i]) continue;
    ++kept;
    CHECK(sorted(before.of(i)) == list);
    for (std::uint32_t k : list) CHECK(s.grid.sites[k].points == whole.sites[k].points);
  }
  CHECK(kept > s.grid.sites.size() / 2);
  // Without parted sites all stays.
  CHECK(count_of(update_neighbors(whole, {}, before, changed)) == count_of(before));
  CHECK(std::count(changed.begin(), changed.end(), 0) ==
        static_cast<std::ptrdiff_t>(whole.sites.size()));
}
