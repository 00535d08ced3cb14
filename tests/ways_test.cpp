// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/ways.h"

#include "support/scenes.h"
#include "turn.h"
#include "world/level.h"
#include "world/rooms.h"
#include "world/topology.h"
#include "world/validate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

std::vector<Way> ways_of(const World& world) { return find_ways(world, Upright(world)); }

// Treads along +x from a place, each 1 m wide, without the last riser's.
void add_flight(std::vector<FoundSurface>& to, double x, double y, double height, int steps,
                double riser, double tread) {
  for (int k = 1; k < steps; ++k)
    to.push_back(level_rectangle(x + (k - 1) * tread, y, x + k * tread, y + 1, height + k * riser));
}

// A floor, eight risers of 17 cm by 28 cm, and a floor above.
std::vector<FoundSurface> flight() {
  std::vector<FoundSurface> surfaces = {level_rectangle(-3, -2, 5, 4, 0)};
  add_flight(surfaces, 1, 0, 0, 8, 0.17, 0.28);
  surfaces.push_back(level_rectangle(1 + 7 * 0.28, -2, 6, 4, 8 * 0.17));
  return surfaces;
}

void check_flight(const Way& way) {
  CHECK(way.kind == WayKind::stairs);
  CHECK(way.steps == 8);
  CHECK(way.riser == doctest::Approx(0.17));
  CHECK(way.tread == doctest::Approx(0.28));
  CHECK(way.width == doctest::Approx(1));
  CHECK((way.foot - Vec3(1, 0.5, 0)).norm() < 1e-5);
  CHECK((way.top - Vec3(2.96, 0.5, 1.36)).norm() < 1e-5);
}

}  // namespace

TEST_CASE("a flight of stairs is told with its risers and treads, and the floors at its ends") {
  const World world = world_with(flight());
  const auto ways = ways_of(world);
  REQUIRE(ways.size() == 1);
  check_flight(ways[0]);
  CHECK(ways[0].floors[0] == world.surfaces[0].id);
  CHECK(ways[0].floors[1] == world.surfaces[8].id);
}

TEST_CASE("stairs are the same in a tilted world") {
  const World world = world_with(flight());
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.3, Vec3(1, 2, 0.5).normalized()));
  const auto ways = ways_of(moved(world, turn, {1, 2, 3}));
  REQUIRE(ways.size() == 1);
  CHECK((ways[0].foot - (turn * Vec3(1, 0.5, 0) + Vec3(1, 2, 3))).norm() < 1e-4);
  CHECK(ways[0].steps == 8);
  CHECK(ways[0].width == doctest::Approx(1).epsilon(1e-4));
}

TEST_CASE("treads that were not seen are counted, as long as fewer are missing than there are") {
  auto surfaces = flight();
  surfaces.erase(surfaces.begin() + 1, surfaces.begin() + 3);  // the first two
  surfaces.erase(surfaces.begin() + 3);                        // and the fifth
  const auto ways = ways_of(world_with(surfaces));
  REQUIRE(ways.size() == 1);
  check_flight(ways[0]);
  surfaces.erase(surfaces.begin() + 1, surfaces.begin() + 3);
  CHECK(ways_of(world_with(surfaces)).empty());
}

TEST_CASE("a landing of two pieces is one") {
  auto surfaces = flight();
  surfaces.back() = level_rectangle(2.96, 0, 3.2, 1, 1.36);
  surfaces.push_back(level_rectangle(3.2, 0, 4, 1, 1.36));
  const auto ways = ways_of(world_with(surfaces));
  REQUIRE(ways.size() == 1);
  check_flight(ways[0]);
  CHECK(ways[0].floors[1]);
}

TEST_CASE("shelves, tables and steps of all sizes are no stairs") {
  std::vector<FoundSurface> surfaces = {level_rectangle(-3, -3, 5, 5, 0)};
  for (int k = 1; k < 8; ++k) surfaces.push_back(level_rectangle(0, 0, 0.3, 1, 0.2 * k));
  CHECK(ways_of(world_with(surfaces)).empty());
  surfaces = {level_rectangle(-3, -3, 5, 5, 0)};
  const double heights[] = {0.1, 0.4, 0.5, 0.9, 1.4};
  for (int k = 0; k < 5; ++k)
    surfaces.push_back(level_rectangle(0.3 * k, 0, 0.3 * (k + 1), 1, heights[k]));
  CHECK(ways_of(world_with(surfaces)).empty());
  // A step and a podium.
  surfaces = {level_rectangle(-3, -3, 5, 5, 0), level_rectangle(0, 0, 0.3, 1, 0.17),
              level_rectangle(0.3, 0, 3, 1, 0.34)};
  CHECK(ways_of(world_with(surfaces)).empty());
}

TEST_CASE("a slope between two floors is a ramp, one without is a roof") {
  std::vector<FoundSurface> surfaces = {level_rectangle(-3, 0, 0, 1.5, 0),
                                        level_rectangle(4, 0, 6, 1.5, 0.5)};
  const Vec3 a(0, 0, 0), b(4, 0, 0.5), c(4, 1.5, 0.5), d(0, 1.5, 0);
  surfaces.push_back(
      {.plane = plane_through(a, (b - a).cross(d - a).normalized()), .outer = {a, b, c, d}});
  const auto ways = ways_of(world_with(surfaces));
  REQUIRE(ways.size() == 1);
  CHECK(ways[0].kind == WayKind::ramp);
  CHECK(ways[0].slope == doctest::Approx(std::atan(0.125)));
  CHECK(ways[0].width == doctest::Approx(1.5));
  CHECK((ways[0].foot - Vec3(0, 0.75, 0)).norm() < 1e-5);
  CHECK((ways[0].top - Vec3(4, 0.75, 0.5)).norm() < 1e-5);
  surfaces.erase(surfaces.begin() + 1);
  CHECK(ways_of(world_with(surfaces)).empty());
}

TEST_CASE("the stairs of a drawn place lead to its podium") {
  const World world = read_world(in_project("worlds/stairs.json"));
  const auto ways = ways_of(world);
  REQUIRE(ways.size() == 1);
  CHECK(ways[0].steps == 10);
  CHECK((ways[0].foot - Vec3(1.2, 5.4, 0)).norm() < 1e-5);
  CHECK((ways[0].top - Vec3(3.72, 5.4, 1.7)).norm() < 1e-5);
}

TEST_CASE("stairs with a landing join the rooms of two storeys in the topological map") {
  // Two rooms over each other, with a half-turn: up along +x, and back beside it.
  std::vector<FoundSurface> surfaces = {level_rectangle(0, 0, 6, 4, 0)};
  add_flight(surfaces, 2, 0, 0, 8, 0.17, 0.28);
  const double landing = 2 + 7 * 0.28;
  surfaces.push_back(level_rectangle(landing, 0, landing + 1.1, 2.1, 8 * 0.17));
  for (int k = 1; k < 8; ++k)
    surfaces.push_back(
        level_rectangle(landing - k * 0.28, 1.1, landing - (k - 1) * 0.28, 2.1, (8 + k) * 0.17));
  FoundSurface upper = level_rectangle(0, 0, 6, 4, 16 * 0.17);
  upper.holes = {{{2, 0.001, 2.72}, {2, 2.1, 2.72}, {5.06, 2.1, 2.72}, {5.06, 0.001, 2.72}}};
  surfaces.push_back(upper);
  for (const double foot : {0.0, 2.72})
    for (const auto& [from, to] : {std::pair{Vec3(0, 0, foot), Vec3(6, 0, foot)},
                                   std::pair{Vec3(6, 0, foot), Vec3(6, 4, foot)},
                                   std::pair{Vec3(6, 4, foot), Vec3(0, 4, foot)},
                                   std::pair{Vec3(0, 4, foot), Vec3(0, 0, foot)}})
      surfaces.push_back(upright_rectangle(from, to, 2.6));
  World world = world_with(surfaces);
  const RoomMap map = find_rooms(world);
  REQUIRE(map.rooms.size() == 2);
  REQUIRE(map.ways.size() == 2);
  CHECK(map.ways[0].rooms == std::array<std::optional<int>, 2>{0, std::nullopt});
  CHECK(map.ways[1].rooms == std::array<std::optional<int>, 2>{std::nullopt, 1});
  world.rooms = map.rooms, world.ways = map.ways;
  CHECK(validate(world).empty());
  const Topology topology = topology_of(world);
  REQUIRE(topology.climbs.size() == 1);
  const PlaceClimb& climb = topology.climbs[0];
  CHECK(climb.ways == std::vector<int>{0, 1});
  CHECK(climb.rooms == std::array<int, 2>{0, 1});
  CHECK(climb.kind == WayKind::stairs);
  CHECK(climb.rise == doctest::Approx(2.72));
  REQUIRE(climb.length);
  CHECK(*climb.length > 2.72 + 2);
}
