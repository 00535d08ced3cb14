// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "scan/distinct.h"

#include <numeric>

#include "parallel.h"
#include "reconstruct.h"
#include "support/scenes.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// Each point of the scan once and up to `more` times again, in any order; tells which was which.
PointCloud with_copies(const PointCloud& scan, int more, Random& random,
                       std::vector<std::size_t>& original) {
  original.resize(scan.points.size());
  std::iota(original.begin(), original.end(), std::size_t{0});
  for (std::size_t i = 0; i < scan.points.size(); ++i)
    original.insert(original.end(), static_cast<std::size_t>(random.whole(0, more)), i);
  shuffle(original, random);
  PointCloud copied;
  for (const std::size_t i : original) {
    copied.points.push_back(scan.points[i]);
    if (!scan.normals.empty()) copied.normals.push_back(scan.normals[i]);
  }
  return copied;
}

}  // namespace

TEST_CASE("each place is kept once, and each point knows its own") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    PointCloud scan;
    for (int i = random.whole(1, 30000); i > 0; --i)
      scan.points.push_back(Vec3f(static_cast<float>(i), static_cast<float>(random.uniform()), -0));
    std::vector<std::size_t> original;
    const PointCloud copied = with_copies(scan, random.whole(1, 5), random, original);
    const DistinctPoints distinct = find_distinct(copied);
    REQUIRE(distinct.cloud);
    CHECK(distinct.cloud->points.size() == scan.points.size());
    CHECK(count_of(distinct) == copied.points.size() - scan.points.size());
    for (std::size_t i = 0; i < copied.points.size(); ++i)
      CHECK(distinct.cloud->points[distinct.place[i]] == copied.points[i]);
  }
}

TEST_CASE("a scan without duplicates is not copied, and an empty one is none") {
  CHECK_FALSE(find_distinct(room_points({3, 2, 2}, 0.05, kNoise)).cloud);
  CHECK_FALSE(find_distinct({}).cloud);
  CHECK(find_distinct({}).expand({1, 2}) == std::vector<std::int32_t>{1, 2});
}

TEST_CASE("0 and -0 are one place, the next number is another") {
  const float next = std::nextafter(1.0f, 2.0f);
  PointCloud scan;
  scan.points = {{0, 1, 0}, {-0.0f, 1, -0.0f}, {0, next, 0}};
  CHECK(count_of(find_distinct(scan)) == 1);
}

TEST_CASE("of unlike points at one place the same is kept in any order") {
  Random random(3);
  PointCloud scan;
  for (int i = 0; i < 50; ++i) {
    scan.points.emplace_back(1, 2, 3);
    scan.normals.push_back(random.direction().cast<float>());
    scan.colors.push_back({static_cast<std::uint8_t>(random.whole(0, 255)), 0, 0});
  }
  const PointCloud kept = *find_distinct(scan).cloud;
  for (int round = 0; round < 5; ++round) {
    for (std::size_t i = scan.points.size(); i > 1; --i) {
      const std::size_t j = random.next() % i;
      std::swap(scan.normals[i - 1], scan.normals[j]);
      std::swap(scan.colors[i - 1], scan.colors[j]);
    }
    const PointCloud again = *find_distinct(scan).cloud;
    CHECK(again.normals == kept.normals);
    CHECK(again.colors == kept.colors);
  }
}

TEST_CASE("of viewpoints of one place the same is kept in any order of points and of viewpoints") {
  Random random(4);
  const std::vector<Vec3> poses = {{3, 0, 1}, {-2, 7, 1}, {-2, 4, 1}};
  for (int round = 0; round < 20; ++round) {
    PointCloud scan;
    std::vector<std::int32_t> order = {0, 1, 2};
    shuffle(order, random);
    for (const std::int32_t k : order)
      scan.viewpoints.push_back(poses[static_cast<std::size_t>(k)]);
    scan.viewers = {-1, 0, 1, 2, 1, 0};
    shuffle(scan.viewers, random);
    scan.points.assign(scan.viewers.size(), {1, 2, 3});
    const PointCloud kept = *find_distinct(scan).cloud;
    REQUIRE(kept.viewers.size() == 1);
    CHECK(kept.viewpoints[static_cast<std::size_t>(kept.viewers[0])] == poses[2]);
  }
}

TEST_CASE("a scan with points told any number of times makes the world of the scan itself") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Random random(seed);
    const PointCloud scan = room_points({4, 3, 2.5}, 0.05, 0.006, seed);
    const ReconstructResult once = reconstruct(scan);
    std::vector<std::size_t> original;
    const PointCloud copied = with_copies(scan, seed == 1 ? 20 : 2, random, original);
    for (int threads : {1, 3}) {
      const ThreadLimit limit(threads);
      const ReconstructResult result = reconstruct(copied);
      CHECK(world_text(result.world) == world_text(once.world));
      CHECK(result.report.duplicates == copied.points.size() - scan.points.size());
      REQUIRE(result.labels.size() == copied.points.size());
      bool are_same = true;
      for (std::size_t i = 0; i < original.size(); ++i)
        are_same = are_same && result.labels[i] == once.labels[original[i]];
      CHECK(are_same);
    }
  }
}

TEST_CASE("a scan merged with itself after rounding keeps its surfaces") {
  PointCloud scan = room_points({4, 3, 2.5}, 0.05, 0.006);
  const std::size_t points = scan.points.size();
  for (std::size_t i = 0; i < points; ++i)
    scan.points.emplace_back((scan.points[i] * 1000).array().round() / 1000);
  CHECK(reconstruct(scan).world.surfaces.size() == 6);
}
