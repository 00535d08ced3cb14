// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/floor_quality.h"

#include "support/scenes.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

FloorQuality floors_of(const std::vector<FoundSurface>& surfaces) {
  World world = world_with(surfaces);
  for (Surface& s : world.surfaces)
    if (s.plane.normal.z() > 0.9) s.kind = Kind::floor;
  return measure_floors(world, RayScene(world));
}

}  // namespace

TEST_CASE("pieces that make up nine tenths of a floor are counted, small ones are not") {
  const FloorQuality halves =
      floors_of({level_rectangle(0, 0, 2, 3, 0), level_rectangle(2, 0, 4, 3, 0)});
  REQUIRE(halves.floors.size() == 1);
  CHECK(halves.floors[0].pieces == 2);
  CHECK(halves.area == doctest::Approx(12));
  CHECK(halves.most_pieces() == 2);
  CHECK(halves.steps == 0);
  CHECK(halves.gaps == 0);
  const FloorQuality patched =
      floors_of({level_rectangle(0, 0, 3.8, 3, 0), level_rectangle(3.8, 0, 4, 3, 0)});
  REQUIRE(patched.floors.size() == 1);
  CHECK(patched.floors[0].pieces == 1);
  std::vector<FoundSurface> strips;
  for (int i = 0; i < 10; ++i)
    strips.push_back(level_rectangle(0.5 * i, 0, 0.5 * (i + 1), 3, 0.002 * i));
  CHECK(floors_of(strips).most_pieces() == 9);
  // A large floor may have more pieces.
  std::vector<FoundSurface> hall;
  for (int i = 0; i < 10; ++i) hall.push_back(level_rectangle(10 * i, 0, 10 * (i + 1), 10, 0));
  CHECK(floors_of(hall).most_pieces() == 1);
}

TEST_CASE("edges where a floor has a small step are as long as they are, high steps are real") {
  for (const double rise : {0.002, 0.006, 0.029, 0.04, 0.17})
    for (const double beside : {0.0, 0.01}) {
      INFO(rise << " " << beside);
      const FloorQuality f =
          floors_of({level_rectangle(0, 0, 2, 3, 0), level_rectangle(2 + beside, 0, 4, 3, rise)});
      const bool is_small = rise > 0.005 && rise < 0.03;
      CHECK(std::abs(f.steps - (is_small ? 3 : 0)) < 0.1);
      CHECK(f.floors.size() == (rise < 0.05 ? 1 : 2));
      CHECK(f.gaps == 0);
    }
  // A second layer that lies over the first has steps all around.
  CHECK(floors_of({level_rectangle(0, 0, 4, 3, 0), level_rectangle(1, 1, 3, 2, 0.01)}).steps ==
        doctest::Approx(6).scale(0).epsilon(0.05));
}

TEST_CASE("gaps between pieces of a floor are as large as they are, but where something stands") {
  const auto left = level_rectangle(0, 0, 2, 3, 0), right = level_rectangle(2.1, 0, 4, 3, 0);
  const FloorQuality open = floors_of({left, right});
  CHECK(open.gaps == doctest::Approx(0.3).scale(0).epsilon(0.05));
  CHECK(open.floors.size() == 1);
  const FloorQuality wall =
      floors_of({left, right, upright_rectangle({2.05, 0, 0}, {2.05, 3, 0}, 2)});
  CHECK(wall.gaps == 0);
  CHECK(wall.floors.size() == 2);
  // A wall with a door of one metre in it.
  const FloorQuality door =
      floors_of({left, right, upright_rectangle({2.05, 0, 0}, {2.05, 1, 0}, 2),
                 upright_rectangle({2.05, 2, 0}, {2.05, 3, 0}, 2)});
  CHECK(door.gaps == doctest::Approx(0.1).scale(0).epsilon(0.1));
  CHECK(door.floors.size() == 1);
  // Wider ones are no gap to fall into but the end of the floor.
  CHECK(floors_of({left, level_rectangle(2.4, 0, 4, 3, 0)}).floors.size() == 2);
}

TEST_CASE("the floors of good worlds are whole") {
  for (const char* name : {"room", "office", "stairs"}) {
    INFO(std::string(name));
    const World world = read_world(in_project(std::string("worlds/") + name + ".json"));
    const FloorQuality quality = measure_floors(world, RayScene(world));
    CHECK(quality.area > 10);
    CHECK(quality.most_pieces() == 1);
    CHECK(quality.steps < 0.3);  // of landings
    CHECK(quality.gaps == 0);
  }
  CHECK(measure_floors({}, RayScene({})).most_pieces() == 0);
}
