// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/glass.h"

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// A wall in y = 0, seen from y > 0, with a window of 1.2 by 1.3 m from x = 2.
World wall_with_window() {
  World world;
  world.vertices = {{0, 0, 0},   {6, 0, 0},   {6, 0, 2.6},   {0, 0, 2.6},
                    {2, 0, 0.9}, {2, 0, 2.2}, {3.2, 0, 2.2}, {3.2, 0, 0.9}};
  Surface wall{.kind = Kind::wall, .outer = {1, 0, 3, 2}, .holes = {{4, 7, 6, 5}}};
  wall.plane = {Vec3::UnitY(), 0};
  world.surfaces = {wall};
  world.openings = {
      {.kind = OpeningKind::window, .loop = {4, 7, 6, 5}, .width = 1.2, .height = 1.3}};
  return world;
}

// Places on the wall, 5 cm apart, and what is on a plane behind it, `apart` [m].
std::vector<Vec3> places_with(double apart) {
  std::vector<Vec3> places;
  for (double x = 0.02; x < 6; x += 0.05)
    for (double z = 0.02; z < 2.6; z += 0.05)
      if (x < 2 || x > 3.2 || z < 0.9 || z > 2.2) places.push_back({x, 0, z});
  for (double x = 0; x < 6; x += apart)
    for (double z = 0; z < 2.6; z += apart) places.push_back({x, -3, z});
  return places;
}

bool is_glass(double apart, const std::vector<Vec3>& viewpoints) {
  const World world = wall_with_window();
  return flag_glass(world, world.openings, places_with(apart), viewpoints)[0].glass;
}

}  // namespace

TEST_CASE("a window that much is seen through is open, one with a few ghosts behind has a pane") {
  for (const auto& viewpoints :
       {std::vector<Vec3>{}, {{2.5, 3, 1.5}}, {{2.5, 3, 1.5}, {20, 1, 1.5}}}) {
    CHECK_FALSE(is_glass(0.05, viewpoints));
    CHECK(is_glass(0.5, viewpoints));
  }
}

TEST_CASE("what is behind the wall beside a window does not open it") {
  World world = wall_with_window();
  std::vector<Vec3> places = places_with(10);
  for (double x = 4; x < 6; x += 0.05)
    for (double z = 0; z < 2.6; z += 0.05) places.push_back({x, -0.5, z});
  CHECK(flag_glass(world, world.openings, places, {{2.5, 1.5, 1.5}})[0].glass);
}

TEST_CASE("a window that no viewpoint looks at tells nothing, nor does a door") {
  CHECK_FALSE(is_glass(0.5, {{5.9, 0.3, 1.5}}));
  World world = wall_with_window();
  world.openings[0].kind = OpeningKind::door;
  CHECK_FALSE(flag_glass(world, world.openings, places_with(0.5), {})[0].glass);
}

TEST_CASE("what is behind a window counts along its own line of sight") {
  const World world = wall_with_window();
  const std::vector<Vec3> places = places_with(0.05), viewpoints = {{2.6, 3, 1.5}, {2.6, -1, 1.5}};
  std::vector<std::int32_t> viewers(places.size(), 0);
  CHECK_FALSE(flag_glass(world, world.openings, places, viewpoints, viewers)[0].glass);
  viewers.assign(places.size(), 1);  // from behind the wall, nothing is seen through it
  CHECK(flag_glass(world, world.openings, places, viewpoints, viewers)[0].glass);
}
