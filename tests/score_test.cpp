// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/score.h"

#include "support/support.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::bench;
using namespace scanworld::test;

namespace {

using Ids = std::vector<std::int32_t>;

// The ids of points that come in runs: 10 of plane 3, 5 of none ...
Ids points(std::initializer_list<std::pair<int, std::int32_t>> runs) {
  Ids ids;
  for (const auto& [count, id] : runs) ids.insert(ids.end(), static_cast<std::size_t>(count), id);
  return ids;
}

bool same(const PlaneScore& a, const PlaneScore& b) {
  return a.asked_for == b.asked_for && a.found == b.found && a.precision == b.precision &&
         a.recall == b.recall && a.f1_50 == b.f1_50 && a.f1_75 == b.f1_75 &&
         a.mean_iou == doctest::Approx(b.mean_iou);
}

}  // namespace

TEST_CASE("planes found as they are score one, whatever they are called") {
  const PlaneScore score = score_planes(points({{10, 0}, {20, 7}, {5, -1}}),
                                        points({{10, 4}, {20, 0}, {5, -1}}), {0, 7});
  CHECK(same(score, {2, 2, 1, 1, 1, 1, 1}));
}

TEST_CASE("a plane is matched by its points in both over its points in either") {
  // 8 of its 10 points and 2 others: 8 / 12.
  const PlaneScore score =
      score_planes(points({{10, 0}, {2, -1}}), points({{2, -1}, {10, 0}}), {0});
  CHECK(score.mean_iou == doctest::Approx(8.0 / 12));
  CHECK(score.f1_50 == 1);
  CHECK(score.f1_75 == 0);
}

TEST_CASE("an IoU of a half is a match, below it is none") {
  CHECK(score_planes(points({{10, 0}}), points({{5, 0}, {5, -1}}), {0}).f1_50 == 1);
  const PlaneScore less = score_planes(points({{10, 0}}), points({{4, 0}, {6, -1}}), {0});
  CHECK(same(less, {1, 1, 0, 0, 0, 0, 0.4}));
  CHECK(score_planes(points({{4, 0}}), points({{3, 0}, {1, -1}}), {0}).f1_75 == 1);
}

TEST_CASE("planes that are missed cost recall, planes that are not there precision") {
  const Ids truth = points({{10, 0}, {10, 1}, {10, -1}});
  const PlaneScore missed = score_planes(truth, points({{10, 0}, {20, -1}}), {0, 1});
  CHECK(same(missed, {2, 1, 1, 0.5, 2.0 / 3, 2.0 / 3, 0.5}));
  const PlaneScore invented = score_planes(truth, points({{10, 0}, {10, 1}, {10, 2}}), {0, 1});
  CHECK(same(invented, {2, 3, 2.0 / 3, 1, 0.8, 0.8, 1}));
}

TEST_CASE("planes in parts and planes in one are found once at most") {
  // The larger part of a plane still is half of it; the smaller is wrong.
  const PlaneScore parted = score_planes(points({{10, 0}}), points({{6, 0}, {4, 1}}), {0});
  CHECK(same(parted, {1, 2, 0.5, 1, 2.0 / 3, 0, 0.6}));
  const PlaneScore united = score_planes(points({{6, 0}, {4, 1}}), points({{10, 0}}), {0, 1});
  CHECK(same(united, {2, 1, 1, 0.5, 2.0 / 3, 0, 0.5}));
}

TEST_CASE("a found plane that is a true one not asked for is neither right nor wrong") {
  const Ids truth = points({{10, 0}, {10, 1}});
  CHECK(same(score_planes(truth, points({{10, 0}, {10, 1}}), {0}), {1, 2, 1, 1, 1, 1, 1}));
  // But one that only touches such a plane is wrong.
  CHECK(score_planes(truth, points({{10, 0}, {4, 1}, {6, -1}}), {0}).precision == 0.5);
  // One that matches it by half and no more is not asked about 0.75 either.
  CHECK(score_planes(truth, points({{10, 0}, {6, 1}, {4, -1}}), {0}).f1_75 == 1);
}

TEST_CASE("without planes the score is zero") {
  CHECK(same(score_planes({}, {}, {}), {}));
  CHECK(same(score_planes(points({{5, 0}}), points({{5, -1}}), {0}), {.asked_for = 1}));
  CHECK(same(score_planes(points({{5, -1}}), points({{5, 0}}), {}), {.found = 1}));
  CHECK(same(score_planes(points({{5, 0}}), points({{5, 0}}), {0, 9}),  // 9 has no points
             {2, 1, 1, 0.5, 2.0 / 3, 2.0 / 3, 0.5}));
}

TEST_CASE("neither the order of the points nor the names of the planes change a score") {
  Random random(5);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
    for (int i = 0; i < 300; ++i) {
      const int id = random.whole(-1, 5);
      pairs.emplace_back(id, random.uniform() < 0.7 ? id : random.whole(-1, 7));
    }
    const auto score = [&](auto true_name, auto found_name) {
      Ids truth, found;
      for (const auto& [t, f] : pairs) {
        truth.push_back(t < 0 ? -1 : true_name(t));
        found.push_back(f < 0 ? -1 : found_name(f));
      }
      return score_planes(truth, found, {true_name(0), true_name(2), true_name(3)});
    };
    const auto kept = [](int id) { return id; };
    const PlaneScore first = score(kept, kept);
    CHECK(first.mean_iou > 0.3);
    CHECK(first.mean_iou < 1);
    shuffle(pairs, random);
    CHECK(same(score(kept, kept), first));
    CHECK(same(score([](int id) { return 1000 - 7 * id; }, [](int id) { return 5 * id + 2; }),
               first));
  }
}

namespace {

// Points of a floor with this id, one after the other in so many squares of 5 cm, seen by a scanner
// at a height of 2 m; each is off by `noise` along its ray.
void add_points(VirtualScan& scan, std::int32_t id, int count, int squares, double noise = 0) {
  const Vec3 pose(0.3, 0.1, 2);
  scan.cloud.viewpoints = {pose};
  for (int i = 0; i < count; ++i) {
    const Vec3 point(0.05 * (i % squares) + 0.025, 0.01, 0);
    const double sign = i % 2 == 0 ? 1 : -1;
    scan.cloud.points.push_back((point + sign * noise * (point - pose).normalized()).cast<float>());
    scan.surface.push_back(id);
    scan.pose.push_back(0);
  }
}

// Floors with these ids, all in one plane.
World floors(std::initializer_list<int> ids) {
  World world;
  for (int id : ids) world.surfaces.push_back({.id = id, .kind = Kind::floor});
  return world;
}

}  // namespace

TEST_CASE("planes are asked for where 100 points lie in 20 squares of 5 cm, whatever the noise") {
  for (double noise : {0.0, 0.05, 0.3}) {
    VirtualScan scan;
    add_points(scan, 1, 100, 20, noise);
    add_points(scan, 2, 99, 20, noise);
    add_points(scan, 3, 100, 19, noise);
    add_points(scan, 9, 5000, 25, noise);
    add_points(scan, -1, 5000, 25, noise);
    CHECK(planes_asked_for(floors({0, 1, 2, 3, 9}), scan) == std::set<std::int32_t>{1, 9});
  }
}

TEST_CASE("the virtual scanner tells surfaces in one plane apart by their ids") {
  const World world = read_world(in_project("worlds/office.json"));
  const VirtualScan scan = virtual_scan(world, {.points = 30000});
  const std::set<std::int32_t> asked_for = planes_asked_for(world, scan);
  CHECK(asked_for.size() > 20);
  int in_one_plane = 0;
  for (const Surface& a : world.surfaces)
    for (const Surface& b : world.surfaces)
      in_one_plane +=
          a.id < b.id && a.plane == b.plane && asked_for.count(a.id) && asked_for.count(b.id);
  CHECK(in_one_plane > 3);
  CHECK(score_planes(scan.surface, scan.surface, asked_for).f1_75 == 1);
}
