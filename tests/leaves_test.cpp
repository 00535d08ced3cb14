// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/leaves.h"

#include "support/scenes.h"
#include "turn.h"
#include "world/level.h"
#include "world/simplify.h"
#include "world/validate.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// A wall that looks to +y with a door from x = 1 to 1.9, and a plate from a place, towards a
// direction.
World door_with(const Vec3& hinge, double heading, double width, double height,
                double thickness = 0.04) {
  FoundSurface wall = upright_rectangle({0, 0, 0}, {4, 0, 0}, 2.5);
  wall.outer = {{0, 0, 0},   {0, 0, 2.5}, {4, 0, 2.5}, {4, 0, 0},
                {1.9, 0, 0}, {1.9, 0, 2}, {1, 0, 2},   {1, 0, 0}};
  const Vec3 end = hinge + width * Vec3(std::cos(heading), std::sin(heading), 0);
  World world = world_with({wall, upright_rectangle(hinge, end, height)});
  world.surfaces[1].thickness = thickness;
  world.surfaces[1].support.points = 1000;
  const Loop& outer = world.surfaces[0].outer;
  world.openings = {{.id = 3,
                     .kind = OpeningKind::door,
                     .surface = 0,
                     .loop = {outer[7], outer[6], outer[5], outer[4]},
                     .width = 0.9,
                     .height = 2,
                     .evidence = "drawn"}};
  return world;
}

std::optional<Leaf> leaf_in(const World& world) { return hang_leaves(world)[0].leaf; }

}  // namespace

TEST_CASE("a leaf ajar is told with its angle, its hinge and where it opens to") {
  // Who stands at y > 0 and looks at the wall has x = 1.9 to the left.
  auto leaf = leaf_in(door_with({1, 0.02, 0}, M_PI / 3, 0.88, 1.98));
  REQUIRE(leaf);
  CHECK(leaf->surface == 1);
  CHECK(leaf->angle == doctest::Approx(M_PI / 3));
  CHECK(leaf->hinge == LeafHinge::right);
  CHECK(leaf->opens_to == LeafSide::front);
  leaf = leaf_in(door_with({1.9, -0.2, 0}, -M_PI / 2 - 0.3, 0.88, 1.98));
  REQUIRE(leaf);
  CHECK(leaf->angle == doctest::Approx(M_PI / 2 - 0.3));
  CHECK(leaf->hinge == LeafHinge::left);
  CHECK(leaf->opens_to == LeafSide::back);
}

TEST_CASE("a leaf is the same in a turned world, which is valid with it, and without it") {
  World world = door_with({1, 0.02, 0}, 2, 0.88, 1.98);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, 0.5).normalized()));
  const auto here = leaf_in(world), there = leaf_in(moved(world, turn, {1, 2, 3}));
  REQUIRE(here);
  REQUIRE(there);
  CHECK(there->angle == doctest::Approx(here->angle).epsilon(1e-4));
  CHECK(there->hinge == here->hinge);
  CHECK(there->opens_to == here->opens_to);
  world.openings = hang_leaves(world);
  CHECK(validate(world).empty());
  world.surfaces.pop_back();
  drop_dangling(world);
  CHECK_FALSE(world.openings[0].leaf);
  CHECK(validate(world).empty());
}

TEST_CASE("walls, cupboards and what is elsewhere are no leaves") {
  CHECK_FALSE(leaf_in(door_with({1, 0.02, 0}, 1, 0.88, 1.98, 0.2)));  // as thick as a wall
  CHECK_FALSE(leaf_in(door_with({1, 0.02, 0}, 1, 0.6, 1.98)));        // too narrow
  CHECK_FALSE(leaf_in(door_with({1, 0.02, 0}, 1, 0.88, 1.5)));        // too low
  CHECK_FALSE(leaf_in(door_with({0.7, 0.02, 0}, 1, 0.88, 1.98)));     // not at the side
  CHECK_FALSE(leaf_in(door_with({1, 0.6, 0}, 1, 0.88, 1.98)));        // before the door
  CHECK_FALSE(leaf_in(door_with({1, 0.02, 0}, 0.05, 0.88, 1.98)));    // closed
}
