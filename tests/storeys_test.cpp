// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/storeys.h"

#include "support/scenes.h"
#include "world/assemble.h"
#include "world/level.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// Level squares of these edges and heights.
World floors_at(const std::vector<std::pair<double, double>>& edges_and_heights) {
  std::vector<FoundSurface> found;
  for (const auto& [edge, height] : edges_and_heights)
    found.push_back(
        {.plane = {Vec3::UnitZ(), -height},
         .outer = {{0, 0, height}, {edge, 0, height}, {edge, edge, height}, {0, edge, height}}});
  World world = assemble_world(found, {});
  for (Surface& s : world.surfaces) s.kind = Kind::floor;
  return world;
}

}  // namespace

TEST_CASE("storeys are the heights of large floors with room for a person between") {
  const World world = floors_at({{5, 3.1}, {8, 0}, {1, 1.5}, {3, 0.3}, {6, 2.9}, {1, 6}});
  const auto storeys = find_storeys(world);
  REQUIRE(storeys.size() == 2);
  CHECK(storeys[0].level == doctest::Approx(0));
  CHECK(storeys[1].level == doctest::Approx(2.9));
  CHECK(storeys[0].area == doctest::Approx(64 + 9));
  CHECK(storeys[1].area == doctest::Approx(25 + 36 + 1 + 1));
  CHECK(main_level(world) == doctest::Approx(0));
}

TEST_CASE("every floor is in one storey, whatever the frame") {
  World world = read_world(in_project("worlds/stairs.json"));
  const auto upright = find_storeys(world);
  world = moved(world, Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized())),
                {5, 6, 7});
  const auto tilted = find_storeys(world);
  REQUIRE(upright.size() == 1);
  REQUIRE(tilted.size() == 1);
  CHECK(upright[0].floors == tilted[0].floors);
  CHECK(upright[0].area == doctest::Approx(tilted[0].area));
  std::size_t floors = 0;
  for (const Surface& s : world.surfaces) floors += s.kind == Kind::floor;
  CHECK(upright[0].floors.size() == floors);
}

TEST_CASE("without floors there is no storey, and the level is that of what is lowest") {
  CHECK(find_storeys({}).empty());
  CHECK(main_level({}) == 0);
  World world = small_world();
  for (Surface& s : world.surfaces) s.kind = Kind::wall;
  for (Vec3& v : world.vertices) v.z() += 2;
  CHECK(find_storeys(world).empty());
  CHECK(main_level(world) == 2);
}
