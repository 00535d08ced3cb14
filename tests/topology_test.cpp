// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/topology.h"

#include "support/scenes.h"
#include "world/level.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

TEST_CASE("the topological map of a drawn place has its rooms and the lengths of its ways") {
  const World world = read_world(in_project("worlds/office.json"));
  const Topology map = topology_of(world);
  REQUIRE(map.nodes.size() == 6);
  CHECK(map.nodes[0].name == "corridor");
  CHECK(*map.nodes[0].area == doctest::Approx(9.6 * 2));
  REQUIRE(map.edges.size() == 7);
  // From (4.8, 1) through the door at (1.575, 2) or (1.575, 2.15) to (2.7, 4.375).
  const PlaceEdge& edge = map.edges[0];
  CHECK(edge.rooms == std::array<int, 2>{0, 1});
  CHECK(edge.width == doctest::Approx(0.95));
  CHECK(edge.place.x() == doctest::Approx(1.575));
  CHECK(edge.place.z() == doctest::Approx(0));
  const double y = edge.place.y();
  REQUIRE(edge.length);
  CHECK(*edge.length ==
        doctest::Approx(std::hypot(4.8 - 1.575, y - 1) + std::hypot(2.7 - 1.575, 4.375 - y)));
}

TEST_CASE("lengths are the same whatever the frame, and no shorter than between the centres") {
  const World world = read_world(in_project("worlds/office.json"));
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()));
  const Topology here = topology_of(world), there = topology_of(moved(world, turn, {1, 2, 3}));
  for (std::size_t i = 0; i < here.edges.size(); ++i) {
    const PlaceEdge& e = here.edges[i];
    CHECK(*there.edges[i].length == doctest::Approx(*e.length).epsilon(1e-5).scale(0));
    const auto center = [&](std::size_t k) {
      return *here.nodes[static_cast<std::size_t>(e.rooms[k])].center;
    };
    CHECK(*e.length >= (center(0) - center(1)).norm());
  }
}

TEST_CASE("a door without a centre on both sides has no length, and one to nowhere is refused") {
  World world = full_world();
  const Topology map = topology_of(world);
  REQUIRE(map.edges.size() == 1);
  CHECK_FALSE(map.edges[0].length);
  CHECK_FALSE(map.nodes[0].area);
  world.doors[0].rooms[1] = 99;
  CHECK(contains(error_of(Cause::check_failed, [&] { topology_of(world); }), "no room 99"));
  world.doors[0] = {98, {0, 1}};
  CHECK(contains(error_of(Cause::check_failed, [&] { topology_of(world); }), "no opening 98"));
  CHECK(topology_of({}).nodes.empty());
}
