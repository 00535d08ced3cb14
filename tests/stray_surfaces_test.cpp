// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/stray_surfaces.h"

#include "support/scenes.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

TEST_CASE("a surface that meets nothing floats") {
  const auto floor = level_rectangle(0, 0, 4, 3, 0),
             wall = upright_rectangle({0, 0, 0}, {4, 0, 0}, 2.5);
  const World joined = world_with({floor, wall});
  CHECK(find_stray_surfaces(joined).floating.empty());
  CHECK(find_stray_surfaces(joined).area == doctest::Approx(22));
  CHECK(find_stray_surfaces(world_with({floor})).floating.empty());  // terrain alone is no fault
  CHECK(find_stray_surfaces({}).floating.empty());
  World table = world_with({floor, wall, level_rectangle(1, 1, 2, 2, 0.75)});
  const StraySurfaces stray = find_stray_surfaces(table);
  CHECK(stray.floating == std::vector<int>{table.surfaces[2].id});
  CHECK(stray.floating_area == doctest::Approx(1));
  // Unless it stands on something, or touches what is near.
  table.obstacles.push_back({.shape = OrientedBox{{1.5, 1.5, 0.37}, {0.1, 0.1, 0.74}}});
  CHECK(find_stray_surfaces(table).floating.empty());
  CHECK(find_stray_surfaces(world_with({floor, wall, level_rectangle(1, 0.03, 2, 1, 0.75)}))
            .floating.empty());
  CHECK(find_stray_surfaces(world_with({floor, wall, level_rectangle(1, 0.08, 2, 1, 0.75)}))
            .floating.size() == 1);
  CHECK(find_stray_surfaces(world_with({floor, upright_rectangle({1, 1, 0.02}, {2, 1, 0.02}, 1)}))
            .floating.empty());
}

TEST_CASE("surfaces cross where they go through each other, not where one ends at the other") {
  const auto floor = level_rectangle(0, 0, 4, 3, 0);
  const World corner = world_with({floor, upright_rectangle({0, 1, 0}, {4, 1, 0}, 2)});
  CHECK(find_stray_surfaces(corner).crossings == 0);
  const StraySurfaces through = find_stray_surfaces(
      world_with({floor, upright_rectangle({1, 1, -1}, {3, 1, -1}, 2)}), {.inside = 0.05});
  CHECK(through.crossings == doctest::Approx(1.9).scale(0).epsilon(0.05));
  CHECK(through.edges == doctest::Approx(11));
  // What stands out by less than is taken for noise does not.
  CHECK(find_stray_surfaces(world_with({floor, upright_rectangle({1, 1, -0.04}, {3, 1, -0.04}, 2)}))
            .crossings == 0);
  // Holes are no place to cross in.
  FoundSurface holed = floor;
  holed.holes = {{{0.5, 0.5, 0}, {0.5, 1.5, 0}, {3.5, 1.5, 0}, {3.5, 0.5, 0}}};
  CHECK(find_stray_surfaces(world_with({holed, upright_rectangle({1, 1, -1}, {3, 1, -1}, 2)}))
            .crossings == 0);
}

TEST_CASE("good worlds have no stray surfaces") {
  for (const char* name : {"room", "office", "stairs"}) {
    INFO(std::string(name));
    const StraySurfaces strays =
        find_stray_surfaces(read_world(in_project(std::string("worlds/") + name + ".json")));
    CHECK(strays.floating.empty());
    CHECK(strays.crossings == 0);
    CHECK(strays.edges > 10);
  }
}
