// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/thickness.h"

#include "support/scenes.h"
#include "world/assemble.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// An upright rectangle at y, from x0 to x1, that looks along +y or -y.
FoundSurface wall(double y, double x0, double x1, bool along_y, double height = 2.5) {
  FoundSurface s{.plane = {along_y ? Vec3::UnitY() : Vec3(-Vec3::UnitY()), along_y ? -y : y},
                 .outer = {{x0, y, 0}, {x0, y, height}, {x1, y, height}, {x1, y, 0}}};
  if (!along_y) std::reverse(s.outer.begin(), s.outer.end());
  return s;
}

World world_of(const std::vector<FoundSurface>& surfaces) { return assemble_world(surfaces, {}); }

}  // namespace

TEST_CASE("two faces back to back are a pair, whichever comes first") {
  for (double thickness : {0.04, 0.1, 0.3, 0.55})
    for (bool swap : {false, true}) {
      std::vector<FoundSurface> faces = {wall(0, 0, 4, true), wall(-thickness, 0.1, 4.2, false)};
      if (swap) std::swap(faces[0], faces[1]);
      World world = world_of(faces);
      const auto pairs = pair_faces(world);
      REQUIRE(pairs.size() == 1);
      CHECK(pairs[0].thickness == doctest::Approx(thickness));
      CHECK(pairs[0].overlap == doctest::Approx(3.9 * 2.5));
      set_thickness(world, pairs);
      for (const Surface& s : world.surfaces) CHECK(*s.thickness == doctest::Approx(thickness));
    }
}

TEST_CASE("faces that are no two sides of one thing are no pair") {
  CHECK(pair_faces(world_of({wall(0, 0, 4, true), wall(-0.02, 0, 4, false)})).empty());
  CHECK(pair_faces(world_of({wall(0, 0, 4, true), wall(-0.7, 0, 4, false)})).empty());
  // The two sides of a narrow passage look at each other.
  CHECK(pair_faces(world_of({wall(0, 0, 4, false), wall(-0.3, 0, 4, true)})).empty());
  CHECK(pair_faces(world_of({wall(0, 0, 4, true), wall(-0.1, 2.1, 6, false)})).empty());
  CHECK(pair_faces(world_of({wall(0, 0, 4, true), wall(-0.1, 0, 4, true)})).empty());
  // Of two walls with a shaft between them, only the faces of each are.
  const auto pairs = pair_faces(world_of({wall(0, 0, 4, true), wall(-0.1, 0, 4, false),
                                          wall(-0.4, 0, 4, true), wall(-0.5, 0, 4, false)}));
  REQUIRE(pairs.size() == 2);
  CHECK((pairs[0].a == 0 && pairs[0].b == 1 && pairs[1].a == 2 && pairs[1].b == 3));
}

TEST_CASE("a long wall has the thickness that it shares most of") {
  World world =
      world_of({wall(0, 0, 10, true), wall(-0.2, 0.2, 7, false), wall(-0.1, 7, 9.8, false)});
  const auto pairs = pair_faces(world);
  CHECK(pairs.size() == 2);
  set_thickness(world, pairs);
  CHECK(*world.surfaces[0].thickness == doctest::Approx(0.2));
  CHECK(*world.surfaces[1].thickness == doctest::Approx(0.2));
  CHECK(*world.surfaces[2].thickness == doctest::Approx(0.1));
}

TEST_CASE("walls of the worlds have the thickness that they were drawn with") {
  World world = read_world(in_project("worlds/office.json"));
  set_thickness(world, pair_faces(world));
  std::size_t known = 0;
  for (const Surface& s : world.surfaces) {
    if (s.kind != Kind::wall || !s.thickness || area(world, s) < 4) continue;
    ++known;
    CHECK((std::abs(*s.thickness - 0.1) < 1e-6 || std::abs(*s.thickness - 0.15) < 1e-6));
  }
  CHECK(known >= 12);
}
