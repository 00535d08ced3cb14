// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/rooms.h"

#include <set>

#include "support/scenes.h"
#include "turn.h"
#include "world/assemble.h"
#include "world/level.h"
#include "world/validate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

World drawn(const char* name) {
  return read_world(in_project(std::string("worlds/") + name + ".json"));
}

// The room that was found where one was drawn.
const Room* found_at(const RoomMap& map, const Room& truth) {
  for (const Room& r : map.rooms)
    if (std::abs(*r.area - *truth.area) < 0.02 * *truth.area &&
        (*r.center - *truth.center).norm() < 0.2)
      return &r;
  return nullptr;
}

std::set<int> walls_and_ceilings(const World& world, const Room& room) {
  std::set<int> ids;
  for (const Surface& s : world.surfaces)
    if (s.kind != Kind::floor && std::count(room.surfaces.begin(), room.surfaces.end(), s.id) > 0)
      ids.insert(s.id);
  return ids;
}

}  // namespace

TEST_CASE("the rooms and doors of drawn places are found as they were drawn") {
  for (const char* name : {"room", "office", "stairs"}) {
    const World world = drawn(name);
    const RoomMap map = find_rooms(world);
    REQUIRE(map.rooms.size() == world.rooms.size());
    std::map<int, int> drawn_as;
    for (const Room& truth : world.rooms) {
      INFO(name << ", " << truth.name);
      const Room* found = found_at(map, truth);
      REQUIRE(found);
      drawn_as[found->id] = truth.id;
      // All walls and the ceiling that were drawn, and the floor.
      const std::set<int> walls = walls_and_ceilings(world, *found);
      for (int id : truth.surfaces) CHECK(walls.count(id) == 1);
      CHECK(found->surfaces.size() > walls.size());
    }
    std::set<std::pair<int, std::set<int>>> doors, truth;
    for (const Door& d : map.doors)
      doors.insert({d.opening, {drawn_as[d.rooms[0]], drawn_as[d.rooms[1]]}});
    for (const Door& d : world.doors)
      if (world.openings[static_cast<std::size_t>(d.opening)].kind != OpeningKind::window)
        truth.insert({d.opening, {d.rooms[0], d.rooms[1]}});
    CHECK(doors == truth);
    CHECK(map.doors.size() == doors.size());
  }
}

TEST_CASE("rooms are numbered from the largest, named after their number, and make a valid world") {
  World world = drawn("office");
  RoomMap map = find_rooms(world);
  for (std::size_t i = 0; i < map.rooms.size(); ++i) {
    CHECK(map.rooms[i].id == static_cast<int>(i));
    CHECK(map.rooms[i].name == "room_" + std::to_string(i));
    if (i > 0) CHECK(*map.rooms[i].area <= *map.rooms[i - 1].area);
  }
  world.rooms = map.rooms, world.doors = map.doors;
  CHECK(validate(world).empty());
  const RoomMap again = find_rooms(world);
  CHECK(again.rooms == map.rooms);
  CHECK(again.doors == map.doors);
  CHECK(parse_world(world_text(world), "w").rooms == map.rooms);
}

TEST_CASE("furniture does not part a room, nor does the order of surfaces matter") {
  World world = drawn("office");
  const RoomMap map = find_rooms(world);
  // A row of cupboards across the workshop, 1.9 m high.
  World full = world;
  full.obstacles.push_back(
      {100, OrientedBox{{2.7, 4.5, 0.95}, {5.4, 0.5, 1.9}, Eigen::Quaterniond::Identity()}});
  CHECK(find_rooms(full).rooms == map.rooms);
  std::reverse(world.surfaces.begin(), world.surfaces.end());
  const RoomMap turned = find_rooms(world);
  CHECK(turned.rooms == map.rooms);
  CHECK(turned.doors == map.doors);
}

TEST_CASE("a tilted world has the same rooms, with their centres where they are") {
  const World world = drawn("office");
  const Eigen::Quaterniond tilt = turn_between(Vec3::UnitZ(), Vec3(0.1, 0.2, 1).normalized());
  const Vec3 shift(3.3, -4.4, 5.5);
  const RoomMap upright = find_rooms(world), tilted = find_rooms(moved(world, tilt, shift));
  REQUIRE(tilted.rooms.size() == upright.rooms.size());
  CHECK(tilted.doors == upright.doors);
  for (std::size_t i = 0; i < upright.rooms.size(); ++i) {
    CHECK(*tilted.rooms[i].area == doctest::Approx(*upright.rooms[i].area).epsilon(0.03));
    CHECK((*tilted.rooms[i].center - (tilt * *upright.rooms[i].center + shift)).norm() < 0.15);
    CHECK(tilted.rooms[i].surfaces == upright.rooms[i].surfaces);
  }
}

TEST_CASE("moving a world moves the centres of its rooms") {
  const World world = drawn("room");
  const World there = moved(world, Eigen::Quaterniond::Identity(), {1, 2, 3});
  REQUIRE(there.rooms.size() == 1);
  CHECK((*there.rooms[0].center - *world.rooms[0].center - Vec3(1, 2, 3)).norm() < 1e-9);
}

TEST_CASE("an open field, a floor alone and nothing at all have no rooms") {
  CHECK(find_rooms({}).rooms.empty());
  CHECK(find_rooms(small_world()).rooms.empty());
  const World wide = scaled(small_world(), 1250);
  CHECK(find_rooms(wide).rooms.empty());
}

TEST_CASE("a box that is seen from outside is no room, though floor is under it") {
  World world = drawn("room");
  // A cupboard up to the ceiling, its four sides facing the room.
  std::vector<FoundSurface> sides;
  const std::vector<Vec2> plan = {{2, 1}, {4, 1}, {4, 2}, {2, 2}};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 a = plan[k], b = plan[(k + 1) % 4], out(b.y() - a.y(), a.x() - b.x());
    const Vec3 normal = Vec3(out.x(), out.y(), 0).normalized();
    sides.push_back(
        {.plane = plane_through({a.x(), a.y(), 0}, normal),
         .outer = {
             {a.x(), a.y(), 0}, {b.x(), b.y(), 0}, {b.x(), b.y(), 2.7}, {a.x(), a.y(), 2.7}}});
  }
  const World cupboard = assemble_world(sides, {});
  const int base = static_cast<int>(world.vertices.size());
  world.vertices.insert(world.vertices.end(), cupboard.vertices.begin(), cupboard.vertices.end());
  for (Surface s : cupboard.surfaces) {
    for (int& v : s.outer) v += base;
    s.id += 1000;
    world.surfaces.push_back(s);
  }
  REQUIRE(validate(world).empty());
  const RoomMap map = find_rooms(world);
  REQUIRE(map.rooms.size() == 1);
  CHECK(*map.rooms[0].area == doctest::Approx(18).epsilon(0.02));
}

TEST_CASE(
    "a room tells how high it is and what it holds, tilted or not; under the sky it does not") {
  const World world = drawn("room");
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.2, Vec3(1, 2, 0).normalized()));
  for (const World& w : {world, moved(world, turn, {1, 2, 3})}) {
    const RoomMap map = find_rooms(w);
    REQUIRE(map.rooms.size() == 1);
    CHECK(map.rooms[0].height.value() == doctest::Approx(2.7).epsilon(1e-4));
    CHECK(map.rooms[0].volume.value() == doctest::Approx(20 * 2.7).epsilon(0.03));
  }
  World open = world;
  std::erase_if(open.surfaces, [](const Surface& s) { return s.kind == Kind::ceiling; });
  const RoomMap map = find_rooms(open);
  REQUIRE(map.rooms.size() == 1);
  CHECK_FALSE(map.rooms[0].height);
  CHECK_FALSE(map.rooms[0].volume);
}

TEST_CASE("under a ceiling that slopes a room holds what is below it") {
  World world = drawn("room");
  for (Surface& s : world.surfaces) {
    if (s.kind != Kind::ceiling || area(world, s) < 10) continue;
    // From 2.7 m at x = 0 to 3.7 m at x = 5.
    for (int& v : s.outer) {
      Vec3 p = world.vertices[static_cast<std::size_t>(v)];
      p.z() += p.x() / 5;
      v = static_cast<int>(world.vertices.size());
      world.vertices.push_back(p);
    }
    s.plane = plane_through({0, 0, 2.7}, Vec3(0.2, 0, -1).normalized());
  }
  const RoomMap map = find_rooms(world);
  REQUIRE(map.rooms.size() == 1);
  CHECK(map.rooms[0].height.value() == doctest::Approx(3.2).epsilon(0.01));
  CHECK(map.rooms[0].volume.value() == doctest::Approx(20 * 3.2).epsilon(0.03));
}

TEST_CASE("two storeys have their own rooms, numbered from the lower one") {
  World world = drawn("room");
  const World above = moved(world, Eigen::Quaterniond::Identity(), {0, 0, 3});
  const int base = static_cast<int>(world.vertices.size());
  world.vertices.insert(world.vertices.end(), above.vertices.begin(), above.vertices.end());
  for (Surface s : above.surfaces) {
    for (int& v : s.outer) v += base;
    for (Loop& hole : s.holes)
      for (int& v : hole) v += base;
    s.id += 1000;
    world.surfaces.push_back(s);
  }
  const RoomMap map = find_rooms(world);
  REQUIRE(map.rooms.size() == 2);
  CHECK(map.rooms[0].center->z() == doctest::Approx(0));
  CHECK(map.rooms[1].center->z() == doctest::Approx(3));
  for (int id : map.rooms[0].surfaces) CHECK(id < 1000);
  for (int id : map.rooms[1].surfaces) CHECK(id >= 1000);
}
