// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/cracks.h"

#include "support/scenes.h"
#include "world/assemble.h"
#include "world/level.h"
#include "world/validate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// A rectangle from `corner` along a and b, seen from where a x b points.
FoundSurface rectangle(const Vec3& corner, const Vec3& a, const Vec3& b) {
  const Vec3 normal = a.cross(b).normalized();
  return {.plane = plane_through(corner, normal),
          .outer = {corner, corner + a, corner + a + b, corner + b}};
}

// Floor at z = 0 and the wall at y = 0, both from x = 0 to 4, that face into the room.
FoundSurface floor() { return rectangle({0, 0, 0}, {4, 0, 0}, {0, 3, 0}); }
FoundSurface wall(double from = 0, double to = 4, double y = 0, double z = 0) {
  return rectangle({from, y, z}, {0, 0, 2.5}, {to - from, 0, 0});
}

std::vector<Crack> cracks_of(const std::vector<FoundSurface>& surfaces) {
  const World world = assemble_world(surfaces, {});
  REQUIRE(validate(world).empty());
  return find_cracks(world);
}

}  // namespace

TEST_CASE("surfaces that share their vertices have no cracks, however the world lies") {
  CHECK(find_cracks({}).empty());
  CHECK(cracks_of({floor(), wall()}).empty());
  Random random(1);
  for (const char* name : {"room", "office", "stairs"}) {
    const World world = read_world(in_project(std::string("worlds/") + name + ".json"));
    for (const Crack& crack : find_cracks(world)) FAIL_CHECK(name, ": ", text_of(crack));
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(random.uniform(0, 3), random.direction()));
    CHECK(find_cracks(moved(world, turn, 10 * random.direction())).empty());
  }
}

TEST_CASE("a vertex inside the edge that another surface goes along is a T-junction") {
  const std::vector<Crack> cracks = cracks_of({floor(), wall(0, 1.5), wall(1.5, 4)});
  REQUIRE(cracks.size() == 1);  // once, though two edges go along
  CHECK(cracks[0].kind == Crack::Kind::t_junction);
  CHECK(cracks[0].surface == 0);
  CHECK(cracks[0].other == 1);
  CHECK(contains(text_of(cracks[0]), "of surface 0 passes vertex"));
  FoundSurface split = floor();
  split.outer.insert(split.outer.begin() + 1, Vec3(1.5, 0, 0));
  CHECK(cracks_of({split, wall(0, 1.5), wall(1.5, 4)}).empty());
  // Not quite on the line, as rounding and joining leave it.
  CHECK(cracks_of({floor(), wall(1, 2, 0.0004)}).size() == 2);
}

TEST_CASE("edges that run near each other without sharing vertices are a crack") {
  for (double width : {0.00002, 0.0004, 0.002, 0.0045}) {
    const std::vector<Crack> cracks = cracks_of({floor(), wall(0, 4, 0, width)});
    REQUIRE(cracks.size() == 1);
    CHECK(cracks[0].kind == Crack::Kind::crack);
    CHECK(cracks[0].width == doctest::Approx(width).epsilon(0.001));
    CHECK(cracks[0].length == doctest::Approx(4));
  }
  CHECK(cracks_of({floor(), wall(0, 4, 0, 0.006)}).empty());
  CHECK(count_of(cracks_of({floor(), wall(1, 2, 0.003)}), Crack::Kind::crack) == 1);
  CHECK(count_of(cracks_of({floor(), wall(-1, 0.5, 0.003)}), Crack::Kind::crack) == 1);
}

TEST_CASE("a crack that opens to a gap is none, one that stays narrow is") {
  for (const auto& [opening, count] : {std::pair{0.004, 1u}, {0.02, 0u}}) {
    FoundSurface askew = rectangle({0, 0, 0}, {0, 0, 2.5}, {4, opening, 0});
    CHECK(cracks_of({floor(), askew}).size() == count);
  }
}

TEST_CASE("what crosses, touches in a point, stands on a face or is thin has no cracks") {
  // A wall through the floor, one that ends at its edge, and a leg on it.
  CHECK(cracks_of({floor(), rectangle({2, -1, -1}, {0, 5, 0}, {0, 0, 2})}).empty());
  CHECK(cracks_of({floor(), rectangle({2, 0, 0}, {0, 0, 2}, {0, -1, 0})}).empty());
  CHECK(cracks_of({floor(), rectangle({2, 1, 0}, {0, 0, 0.7}, {0.05, 0, 0})}).empty());
  // The two faces of a board of 3 cm, and of a sheet of 4 mm.
  for (double thickness : {0.03, 0.004}) {
    const FoundSurface front = rectangle({1, 1, 1}, {1, 0, 0}, {0, 1, 0});
    FoundSurface back = rectangle({1, 1, 1 - thickness}, {0, 1, 0}, {1, 0, 0});
    CHECK(cracks_of({front, back}).empty());
    back.plane = back.plane.flipped();
    std::reverse(back.outer.begin(), back.outer.end());
    CHECK(cracks_of({front, back}).size() == (thickness < 0.01 ? 4 : 0));  // a step
  }
}

TEST_CASE("a closed box near a closed corner is no crack, an open one is") {
  const auto box = [](double gap) {
    const Vec3 a(1, gap, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    std::vector<FoundSurface> faces = {rectangle(a, y, x), rectangle(a, x, z), rectangle(a, z, y),
                                       rectangle(a + x, y, z), rectangle(a + y, z, x)};
    return faces;
  };
  std::vector<FoundSurface> place = box(0.003);
  const FoundSurface shelf = rectangle({0, 0, 0}, {4, 0, 0}, {0, -1, 0});
  place.push_back(shelf), place.push_back(wall());
  for (Vec3& v : place.back().outer) v.y() = 0;
  CHECK(count_of(cracks_of(place), Crack::Kind::crack) == 0);
  place.erase(place.begin());  // its bottom
  CHECK(count_of(cracks_of(place), Crack::Kind::crack) > 0);
}

TEST_CASE("long edges all over a large place are looked at quickly, and none is missed") {
  std::vector<FoundSurface> strips;
  for (int k = 0; k < 400; ++k)
    strips.push_back(rectangle({0, 0.25 * k, 0}, {100, 0, 0}, {0, 0.25 - (k % 2) * 0.002, 0}));
  CHECK(cracks_of(strips).size() == 199);
}
