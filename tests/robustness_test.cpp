// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sim_check/robustness.h"

#include "sim_check/baselines/tessellate.h"
#include "support/places.h"
#include "world/virtual_scan.h"

using namespace scanworld;
using namespace scanworld::sim;
using namespace scanworld::test;

namespace {

const EngineMaker& engine() { return engine_named("bullet"); }

RobustnessOptions quick() { return {.robots = 20, .seconds = 2, .walls = 60, .rays = 1000}; }

// Two slabs beside each other, so far apart, in a room without walls.
Place slabs(double apart) {
  return boxes_place(
      {box_body({-2, -2, -0.3}, {-apart / 2, 2, 0}), box_body({apart / 2, -2, -0.3}, {2, 2, 0})});
}

FloorGaps gaps_of(const Place& place, const PointCloud* scan = nullptr) {
  const Spots spots = find_spots({place}, {.count = 20});
  return find_floor_gaps(place, spots, scan, {});
}

}  // namespace

TEST_CASE("no robot is lost in a room, and all doors and walls are what they are") {
  const Place place = place_of("room", world_named("room"));
  const Spots spots = find_spots({place}, {.count = 20});
  const Lost lost = drive_at(place, MeshRays(place.seen), spots, engine(), 5, 60, quick());
  CHECK(lost.robots == 20);
  CHECK(lost.at.empty());
  const auto simulation = engine().make(place, {}, {}, {});
  const Doors doors = go_through(*place.world, *simulation, quick());
  CHECK(doors.wide == 1);
  CHECK(doors.passed == 1);
  CHECK(doors.walls == 60);
  CHECK(doors.walls_open == 0);
}

TEST_CASE("walls that robots go through are found, by driving and by sweeping") {
  Place place = place_of("room", world_named("room"));
  std::erase_if(place.solids, [](const ExportBody& b) { return b.name.starts_with("wall"); });
  const Spots spots = find_spots({place}, {.count = 20});
  CHECK(!drive_at(place, MeshRays(place.seen), spots, engine(), 2, 60, quick()).at.empty());
  const auto simulation = engine().make(place, {}, {}, {});
  CHECK(go_through(*place.world, *simulation, quick()).walls_open > 20);
}

TEST_CASE("a door with a board across is blocked, and one that is too narrow does not count") {
  Place place = place_of("room", world_named("room"));
  const auto door = std::ranges::find(place.world->openings, OpeningKind::door, &Opening::kind);
  REQUIRE(door != place.world->openings.end());
  RobustnessOptions wide = quick();
  wide.width = door->width;
  const auto before = engine().make(place, {}, {}, {});
  CHECK(go_through(*place.world, *before, wide).narrow == 1);
  Vec3 middle = Vec3::Zero();
  for (int v : door->loop) middle += place.world->vertices[v] / double(door->loop.size());
  middle.z() = 0.3;
  place.solids.push_back(box_body(middle - Vec3(2, 2, 0.02), middle + Vec3(2, 2, 0.02)));
  const auto after = engine().make(place, {}, {}, {});
  const Doors doors = go_through(*place.world, *after, quick());
  CHECK(doors.passed == 0);
  CHECK(doors.blocked == std::vector<int>{door->id});
}

TEST_CASE("gaps in the floor are found where they are narrower than the wheelbase") {
  const FloorGaps closed = gaps_of(slabs(0));
  CHECK(closed.gaps.empty());
  CHECK(closed.drivable == doctest::Approx(16).epsilon(0.05));
  const FloorGaps narrow = gaps_of(slabs(0.1));
  REQUIRE(narrow.gaps.size() == 1);
  CHECK(narrow.area == doctest::Approx(0.4).epsilon(0.25));
  CHECK(std::abs(narrow.gaps[0].at.x()) < 0.06);
  CHECK(gaps_of(slabs(0.5)).gaps.empty());
}

TEST_CASE("a gap that the scanner saw is one of the place's own") {
  PointCloud scan;
  for (double y = -2; y < 2; y += 0.01)
    for (double x = -0.06; x < 0.06; x += 0.01)
      scan.points.push_back(Vec3f(float(x), float(y), -0.4f));
  CHECK(gaps_of(slabs(0.1), &scan).gaps.empty());
}

TEST_CASE("there is no floor within a wall that stands on it") {
  const Place place = boxes_place({box_body({-2, -2, -0.3}, {2.1, 2, 0}),
                                   box_body({2, -2, -0.01}, {2.3, 0, 1}),
                                   box_body({2, 0.1, -0.01}, {2.3, 2, 1})});
  const FloorGaps found = gaps_of(place);
  CHECK(found.gaps.empty());
  CHECK(found.drivable == doctest::Approx(4 * 4).epsilon(0.02));
}

TEST_CASE("a step or the side of a ramp is no gap") {
  CHECK(gaps_of(boxes_place(
                    {box_body({-2, -2, -0.3}, {0, 2, 0}), box_body({0, -2, -0.3}, {2, 2, -0.1})}))
            .gaps.empty());
}

TEST_CASE("a cube slides and a ball rolls over a slab without loss, and not over a rough mesh") {
  const Place slab = boxes_place({box_body({-3, -3, -0.1}, {3, 3, 0})});
  const Place rough = place_of("rough", tessellate(grid_mesh(2, 6), {.triangles = 100000}));
  const std::vector<Place> places = {slab, rough};
  const Spots spots = find_spots(places, {.count = 20});
  const auto lanes = find_lanes(places, spots, 1, 3);
  REQUIRE(lanes.size() == 3);
  for (RobotKind kind : {RobotKind::cube, RobotKind::ball}) {
    CHECK(std::abs(glide(slab, lanes, engine(), kind, quick()).speed_lost) < 0.001);
    CHECK(glide(rough, lanes, engine(), kind, quick()).speed_lost > 0.05);
  }
}

TEST_CASE("the lidar error of a true world is that of the scanner's noise") {
  const World world = world_named("room");
  const VirtualScan scan = virtual_scan(world, {.points = 20000, .noise = 0.01});
  const auto simulation = engine().make(place_of("room", world), {}, {}, {});
  const LidarError error = compare_lidar(*simulation, scan.cloud, quick());
  CHECK(error.rays > 900);
  CHECK(error.median == doctest::Approx(0.0067).epsilon(0.2));
  CHECK(error.missed < 0.01);
}
