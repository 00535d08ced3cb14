// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/openings.h"

#include "support/support.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// A wall in y = 0 from x = 0 to 6, 3 m high, that looks to -y, with a notch at the bottom and a
// hole, upright rectangles each.
World wall_with(const Eigen::AlignedBox2d& notch, const Eigen::AlignedBox2d& hole) {
  World world;
  const auto add = [&](double x, double z) {
    world.vertices.emplace_back(x, 0, z);
    return static_cast<int>(world.vertices.size()) - 1;
  };
  const Vec2 &a = notch.min(), &b = notch.max(), &c = hole.min(), &d = hole.max();
  Surface wall{.id = 7, .kind = Kind::wall, .plane = {-Vec3::UnitY(), 0}};
  wall.outer = {add(0, 0),         add(a.x(), 0), add(a.x(), b.y()), add(b.x(), b.y()),
                add(b.x(), a.y()), add(6, 0),     add(6, 3),         add(0, 3)};
  wall.holes = {{add(c.x(), c.y()), add(c.x(), d.y()), add(d.x(), d.y()), add(d.x(), c.y())}};
  world.surfaces.push_back(wall);
  return world;
}

World wall_with_door_and_window() {
  return wall_with({Vec2(1, 0), Vec2(1.9, 2.05)}, {Vec2(3, 0.9), Vec2(4.2, 2.1)});
}

// The same wall's other face, 0.2 m behind.
void add_back(World& world) {
  Surface back = world.surfaces[0];
  const int n = static_cast<int>(world.vertices.size());
  for (int v = 0; v < n; ++v)
    world.vertices.push_back(world.vertices[static_cast<std::size_t>(v)] + 0.2 * Vec3::UnitY());
  const auto turn = [&](Loop& loop) {
    std::reverse(loop.begin(), loop.end());
    for (int& v : loop) v += n;
  };
  turn(back.outer);
  for (Loop& hole : back.holes) turn(hole);
  back.id = 8, back.plane = plane_through({0, 0.2, 0}, Vec3::UnitY());
  world.surfaces.push_back(back);
}

}  // namespace

TEST_CASE("a notch that ends a little over the floor on one side is a door still") {
  for (const std::size_t foot : {1u, 4u}) {
    World world = wall_with_door_and_window();
    world.vertices[foot].z() = 0.12;
    const std::vector<Opening> openings = find_openings(world);
    REQUIRE(openings.size() == 2);
    CHECK(openings[1].kind == OpeningKind::door);
    CHECK(openings[1].width == doctest::Approx(0.9));
    CHECK(openings[1].height == doctest::Approx(2.05 - 0.12));
  }
}

TEST_CASE("a notch at the bottom is a door, a hole above is a window, of their clear sizes") {
  const std::vector<Opening> openings = find_openings(wall_with_door_and_window());
  REQUIRE(openings.size() == 2);
  const Opening &window = openings[0], &door = openings[1];
  CHECK(window.kind == OpeningKind::window);
  CHECK(window.width == doctest::Approx(1.2));
  CHECK(window.height == doctest::Approx(1.2));
  CHECK(door.kind == OpeningKind::door);
  CHECK(door.width == doctest::Approx(0.9));
  CHECK(door.height == doctest::Approx(2.05));
  CHECK(door.surface == 7);
  CHECK(door.loop.size() == 4);
}

TEST_CASE("an opening in both faces is told once, as wide as the narrower face leaves it") {
  World world = wall_with_door_and_window();
  add_back(world);
  // The back face's door is narrower by 5 cm on one side.
  for (int v : world.surfaces[1].outer) {
    Vec3& p = world.vertices[static_cast<std::size_t>(v)];
    if (p.x() == 1) p.x() = 1.05;
  }
  const std::vector<Opening> openings = find_openings(world);
  REQUIRE(openings.size() == 2);
  CHECK(openings[1].width == doctest::Approx(0.85));
  CHECK(openings[1].evidence.find("both faces") != std::string::npos);
}

TEST_CASE("large ones are passages; low, slanting and small ones are no openings") {
  const Eigen::AlignedBox2d window(Vec2(4.5, 0.9), Vec2(5.7, 2.1));
  const auto kind_of_notch = [&](double width, double height) -> std::optional<OpeningKind> {
    const auto openings = find_openings(wall_with({Vec2(1, 0), Vec2(1 + width, height)}, window));
    if (openings.size() < 2) return std::nullopt;
    return openings[1].kind;
  };
  CHECK(kind_of_notch(0.9, 2.05) == OpeningKind::door);
  CHECK(kind_of_notch(2.5, 2.2) == OpeningKind::passage);
  CHECK(kind_of_notch(0.9, 2.8) == OpeningKind::passage);
  CHECK_FALSE(kind_of_notch(0.9, 0.8).has_value());
  CHECK_FALSE(kind_of_notch(0.2, 2.05).has_value());
  World slanting = wall_with_door_and_window();
  slanting.vertices[2].x() += 0.8;  // the notch is a triangle now
  CHECK(find_openings(slanting).size() == 1);
}

TEST_CASE("lines of sight are counted where they go through, not where they end before") {
  const World world = wall_with_door_and_window();
  const std::vector<SightLine> lines = {{{1.5, -2, 1}, {1.5, 2, 1}},     // through the door
                                        {{1.5, -2, 1}, {1.5, -0.5, 1}},  // ends before it
                                        {{2.5, -2, 1}, {2.5, 2, 1}}};    // through the wall
  const std::vector<Opening> openings = find_openings(world, lines);
  REQUIRE(openings.size() == 2);
  CHECK(openings[0].evidence.find("no line of sight") != std::string::npos);
  CHECK(openings[1].evidence.find("1 lines of sight") != std::string::npos);
}

TEST_CASE("a notch in one face that no line of sight goes through is where a thing stands") {
  const World world = wall_with_door_and_window();
  const std::vector<SightLine> lines = {{{2.5, -2, 1}, {2.5, 2, 1}}};  // through the wall
  const std::vector<Opening> openings = find_openings(world, lines);
  REQUIRE(openings.size() == 1);
  CHECK(openings[0].kind == OpeningKind::window);
}

TEST_CASE("the openings of the drawn worlds are found again") {
  for (const char* name : {"room", "office", "stairs"}) {
    CAPTURE(name);
    const World world = read_world(std::filesystem::path(SCANWORLD_SOURCE_DIR) / "worlds" /
                                   (std::string(name) + ".json"));
    const std::vector<Opening> found = find_openings(world);
    for (const Opening& drawn : world.openings) {
      CAPTURE(drawn.id);
      CHECK(std::any_of(found.begin(), found.end(), [&](const Opening& o) {
        return o.kind == drawn.kind && std::abs(o.width - drawn.width) < 0.01 &&
               std::abs(o.height - drawn.height) < 0.01;
      }));
    }
    CHECK(found.size() <= world.openings.size());
  }
}
