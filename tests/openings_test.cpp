// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/openings.h"

#include "support/support.h"
#include "world/validate.h"
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

// The only opening that is no window.
Opening door_of(const World& world) {
  std::vector<Opening> found = find_openings(world).openings;
  std::erase_if(found, [](const Opening& o) { return o.kind == OpeningKind::window; });
  REQUIRE(found.size() == 1);
  CHECK(found[0].kind == OpeningKind::door);
  return found[0];
}

}  // namespace

TEST_CASE("a notch that ends a little over the floor on one side is a door still") {
  for (const std::size_t foot : {1u, 4u}) {
    World world = wall_with_door_and_window();
    world.vertices[foot].z() = 0.12;
    const Opening door = door_of(world);
    CHECK(door.width == doctest::Approx(0.9));
    CHECK(door.height == doctest::Approx(2.05));
  }
}

TEST_CASE("a notch at the bottom is a door, a hole above is a window, of their clear sizes") {
  const World world = wall_with_door_and_window();
  const FoundOpenings found = find_openings(world);
  REQUIRE(found.openings.size() == 2);
  const Opening &door = found.openings[0], &window = found.openings[1];
  CHECK(window.kind == OpeningKind::window);
  CHECK(window.width == doctest::Approx(1.2));
  CHECK(window.height == doctest::Approx(1.2));
  CHECK(door.kind == OpeningKind::door);
  CHECK(door.width == doctest::Approx(0.9));
  CHECK(door.height == doctest::Approx(2.05));
  CHECK(door.surface == 7);
  CHECK(door.loop.size() == 4);
  CHECK(found.corners.empty());  // all are the wall's
}

TEST_CASE("an opening in both faces is told once, as wide as the narrower face leaves it") {
  World world = wall_with_door_and_window();
  add_back(world);
  // The back face's door is narrower by 5 cm on one side.
  for (int v : world.surfaces[1].outer) {
    Vec3& p = world.vertices[static_cast<std::size_t>(v)];
    if (p.x() == 1) p.x() = 1.05;
  }
  CHECK(find_openings(world).openings.size() == 2);
  const Opening door = door_of(world);
  CHECK(door.width == doctest::Approx(0.85));
  CHECK(door.evidence.find("both faces") != std::string::npos);
}

TEST_CASE("the sides within a wall tell a door's width, not where its face ends at a casing") {
  World world = wall_with_door_and_window();
  for (const double x : {1.07, 1.83}) {
    Surface jamb{.id = world.surfaces.back().id + 1,
                 .kind = Kind::wall,
                 .plane = plane_through({x, 0, 0}, x < 1.5 ? Vec3(1, 0, 0) : Vec3(-1, 0, 0))};
    for (const auto& [y, z] : {std::pair{-0.015, 0.0}, {0.1, 0.0}, {0.1, 2.05}, {-0.015, 2.05}}) {
      jamb.outer.push_back(static_cast<int>(world.vertices.size()));
      world.vertices.emplace_back(x, y, z);
    }
    world.surfaces.push_back(jamb);
  }
  const Opening door = door_of(world);
  CHECK(door.width == doctest::Approx(0.76));
  CHECK(door.height == doctest::Approx(2.05));
  CHECK(find_openings(world).corners.size() == 4);
}

TEST_CASE("an opening lies in the plane of its surface where a wall's pieces are a little apart") {
  World world;
  const auto add_piece = [&](double y, const std::vector<Vec2>& outline) {
    Surface piece{.id = static_cast<int>(world.surfaces.size()),
                  .kind = Kind::wall,
                  .plane = plane_through({0, y, 0}, -Vec3::UnitY())};
    for (const Vec2& p : outline) {
      piece.outer.push_back(static_cast<int>(world.vertices.size()));
      world.vertices.emplace_back(p.x(), y, p.y());
    }
    world.surfaces.push_back(piece);
  };
  add_piece(0, {{0, 0}, {1, 0}, {1, 3}, {0, 3}});
  add_piece(0.0019, {{1.9, 0}, {6, 0}, {6, 3}, {1, 3}, {1, 2.05}, {1.9, 2.05}});
  const FoundOpenings found = find_openings(world);
  REQUIRE(found.openings.size() == 1);
  world.openings = found.openings;
  world.vertices.insert(world.vertices.end(), found.corners.begin(), found.corners.end());
  CHECK(find_surface(world, found.openings[0].surface)->plane.offset != 0);  // the lintel's
  CHECK(validate(world).empty());
}

TEST_CASE("a window that a curtain hides a part of one side of is one still") {
  World world = wall_with_door_and_window();
  const auto add = [&](double x, double z) {
    world.vertices.emplace_back(x, 0, z);
    return static_cast<int>(world.vertices.size()) - 1;
  };
  Loop& hole = world.surfaces[0].holes[0];
  hole.insert(hole.begin() + 1, {add(3, 1.2), add(3.07, 1.2), add(3.07, 1.6), add(3, 1.6)});
  std::vector<Opening> found = find_openings(world).openings;
  std::erase_if(found, [](const Opening& o) { return o.kind != OpeningKind::window; });
  REQUIRE(found.size() == 1);
  CHECK(found[0].width == doctest::Approx(1.13));
  CHECK(found[0].height == doctest::Approx(1.2));
}

TEST_CASE("what a cupboard hides of one face beside a door is none of it where the other face is") {
  World world = wall_with_door_and_window();
  add_back(world);
  // The face before ends at the cupboard, 1 m beside the door and 1.5 m high.
  const auto add = [&](double x, double z) {
    world.vertices.emplace_back(x, 0, z);
    return static_cast<int>(world.vertices.size()) - 1;
  };
  Loop& outer = world.surfaces[0].outer;
  outer.erase(outer.begin() + 4);
  outer.insert(outer.begin() + 4, {add(1.9, 1.5), add(2.9, 1.5), add(2.9, 0)});
  const Opening door = door_of(world);
  CHECK(door.width == doctest::Approx(0.9));
  CHECK(door.height == doctest::Approx(2.05));
}

TEST_CASE("a wall in pieces around a doorway has one still") {
  World world;
  const auto add = [&](double x0, double x1, double z0, double z1) {
    Surface piece{.id = static_cast<int>(world.surfaces.size()),
                  .kind = Kind::wall,
                  .plane = {-Vec3::UnitY(), 0}};
    for (const auto& [x, z] : {std::pair{x0, z0}, {x1, z0}, {x1, z1}, {x0, z1}}) {
      piece.outer.push_back(static_cast<int>(world.vertices.size()));
      world.vertices.emplace_back(x, 0, z);
    }
    world.surfaces.push_back(piece);
  };
  add(0, 2, 0, 2.7), add(2.9, 5, 0, 2.7);
  CHECK(find_openings(world).openings.empty());  // up to the ceiling: two walls
  add(2, 2.9, 2.1, 2.7);
  const Opening door = door_of(world);
  CHECK(door.width == doctest::Approx(0.9));
  CHECK(door.height == doctest::Approx(2.1));
}

TEST_CASE("large ones are passages; low, slanting and small ones are no openings") {
  const Eigen::AlignedBox2d window(Vec2(4.5, 0.9), Vec2(5.7, 2.1));
  const auto kind_of_notch = [&](double width, double height) -> std::optional<OpeningKind> {
    const World world = wall_with({Vec2(1, 0), Vec2(1 + width, height)}, window);
    for (const Opening& o : find_openings(world).openings)
      if (o.kind != OpeningKind::window) return o.kind;
    return std::nullopt;
  };
  CHECK(kind_of_notch(0.9, 2.05) == OpeningKind::door);
  CHECK(kind_of_notch(2.5, 2.2) == OpeningKind::passage);
  CHECK(kind_of_notch(0.9, 2.8) == OpeningKind::passage);
  CHECK_FALSE(kind_of_notch(0.9, 0.8).has_value());
  CHECK_FALSE(kind_of_notch(0.2, 2.05).has_value());
  World slanting = wall_with_door_and_window();
  slanting.vertices[2].x() += 0.8;  // the notch is a triangle now
  CHECK(find_openings(slanting).openings.size() == 1);
}

TEST_CASE("an opening needs lines of sight through it, as dense as places are on the wall") {
  const World world = wall_with_door_and_window();
  std::vector<SightLine> lines = {{{1.5, -2, 1}, {1.5, -0.5, 1}},  // ends before the door
                                  {{2.5, -2, 1}, {2.5, 2, 1}}};    // through the wall
  std::vector<Vec3> places, before;
  for (double x = 0.05; x < 6; x += 0.1)
    for (double z = 0.05; z < 3; z += 0.1)
      (x < 1 || x > 4.2 || z > 2.1 ? places : before).emplace_back(x, 0, z);
  for (Vec3& p : before) p.y() = -0.3;
  // The door was not seen through; of the window at least nothing stands before it.
  FoundOpenings found = find_openings(world, {lines, places});
  REQUIRE(found.openings.size() == 1);
  CHECK(found.openings[0].kind == OpeningKind::window);
  CHECK(found.openings[0].evidence.find("no line of sight") != std::string::npos);
  // Things hide it.
  std::vector<Vec3> hidden = places;
  hidden.insert(hidden.end(), before.begin(), before.end());
  CHECK(find_openings(world, {lines, hidden}).openings.empty());
  // Many lines go through the door, a stray one through the window.
  for (double x = 1.05; x < 1.9; x += 0.1)
    for (double z = 0.05; z < 2; z += 0.1) lines.push_back({{1.5, -2, 1}, {x, 0.5, z}});
  lines.push_back({{3.6, -2, 1.5}, {3.6, 2, 1.5}});
  found = find_openings(world, {lines, hidden});
  REQUIRE(found.openings.size() == 1);
  CHECK(found.openings[0].kind == OpeningKind::door);
  CHECK(found.openings[0].evidence.find("lines of sight go through") != std::string::npos);
}

TEST_CASE("where no viewpoint is known, what things stand before in one face is no opening") {
  World world = wall_with_door_and_window();
  std::vector<Vec3> places;
  for (double x = 1; x < 2; x += 0.05)
    for (double z = 0; z < 2.1; z += 0.05) places.emplace_back(x, -0.4, z);
  CHECK(find_openings(world, {{}, places}).openings.size() == 1);
  add_back(world);
  CHECK(find_openings(world, {{}, places}).openings.size() == 2);
}

TEST_CASE("the openings of the drawn worlds are found again") {
  for (const char* name : {"room", "office", "stairs"}) {
    CAPTURE(name);
    const World world = read_world(std::filesystem::path(SCANWORLD_SOURCE_DIR) / "worlds" /
                                   (std::string(name) + ".json"));
    const std::vector<Opening> found = find_openings(world).openings;
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
