// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/leave_out.h"

#include <algorithm>

#include "error.h"
#include "support/places.h"
#include "world/assemble.h"
#include "world/colliders.h"
#include "world/simplify.h"
#include "world/thickness.h"
#include "world/validate.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

constexpr WorldPart kParts[] = {WorldPart::obstacles, WorldPart::colliders, WorldPart::openings,
                                WorldPart::surfaces, WorldPart::inferred};

std::vector<std::set<WorldPart>> all_combinations() {
  std::vector<std::set<WorldPart>> all(1);
  for (WorldPart part : kParts)
    for (std::size_t i = 0, before = all.size(); i < before; ++i) {
      all.push_back(all[i]);
      all.back().insert(part);
    }
  return all;
}

// A place with solids, some of whose surfaces are inferred.
World place(const std::string& name) {
  World world = world_named(name);
  Random random(7);
  for (Surface& s : world.surfaces)
    if (random.uniform(0, 1) < 0.3) s.source = Source::inferred;
  world.surfaces[0].curve = 3, world.obstacles[0].curve = 4;
  for (int id : {3, 4}) {
    CurvedPart part{.id = id};
    part.curve.shape.radius = part.curve.high = 1;
    world.curves.push_back(part);
  }
  world.colliders = make_colliders(world);
  return world;
}

std::vector<World> places() { return {place("room"), place("office"), place("stairs")}; }

std::vector<Vec3> corners(const World& world, const Loop& loop) {
  std::vector<Vec3> points;
  for (int v : loop) points.push_back(world.vertices[static_cast<std::size_t>(v)]);
  return points;
}

// A wall whose two faces are `thickness` apart; only that to +y was measured, and it is smaller.
World wall_with_inferred_back(double thickness) {
  FoundSurface front{.plane = {Vec3::UnitY(), 0},
                     .outer = {{0, 0, 0}, {0, 0, 2}, {4, 0, 2}, {4, 0, 0}}};
  FoundSurface back{
      .plane = {-Vec3::UnitY(), -thickness},
      .outer = {
          {-1, -thickness, 0}, {5, -thickness, 0}, {5, -thickness, 2.5}, {-1, -thickness, 2.5}}};
  World world = assemble_world({front, back}, {});
  world.surfaces[1].source = Source::inferred;
  set_thickness(world, pair_faces(world));
  world.colliders = make_colliders(world);
  return world;
}

}  // namespace

TEST_CASE("a world without any of its parts is valid, and the same when they are left out again") {
  for (const World& world : places()) {
    REQUIRE(validate(world).empty());
    for (const std::set<WorldPart>& parts : all_combinations()) {
      const World less = leave_out(world, parts);
      const std::vector<std::string> reasons = validate(less);
      CHECK_MESSAGE(reasons.empty(), (reasons.empty() ? "" : reasons[0]));
      CHECK(leave_out(less, parts) == less);
    }
  }
}

TEST_CASE("leaving out nothing, or what is not there, changes nothing") {
  for (const World& world : places()) CHECK(leave_out(world, {}) == world);
  CHECK(leave_out(full_world(), {}) == full_world());
  CHECK(leave_out(world_named("office"), {WorldPart::colliders, WorldPart::inferred}) ==
        world_named("office"));
}

TEST_CASE("what is left out is gone, and all that does not hang on it is as before") {
  for (const World& world : places())
    for (const std::set<WorldPart>& parts : all_combinations()) {
      const World less = leave_out(world, parts);
      const auto stays = [&](const Surface& s) {
        return !parts.contains(WorldPart::surfaces) &&
               !(parts.contains(WorldPart::inferred) && s.source == Source::inferred);
      };
      for (const Surface& s : world.surfaces) {
        const Surface* same = find_surface(less, s.id);
        CHECK((same != nullptr) == stays(s));
        if (!same) continue;
        CHECK(same->plane == s.plane);
        CHECK(same->curve == s.curve);
        CHECK(corners(less, same->outer) == corners(world, s.outer));
        CHECK(same->holes.size() == s.holes.size());
      }
      CHECK(less.obstacles ==
            (parts.contains(WorldPart::obstacles) ? std::vector<Obstacle>() : world.obstacles));
      const auto has_surface = [&](const Opening& o) {
        return stays(*find_surface(world, o.surface));
      };
      CHECK(static_cast<long>(less.openings.size()) ==
            (parts.contains(WorldPart::openings)
                 ? 0
                 : std::count_if(world.openings.begin(), world.openings.end(), has_surface)));
      CHECK(less.colliders.empty() ==
            (parts.contains(WorldPart::colliders) || parts.contains(WorldPart::surfaces)));
      CHECK(less.rooms.size() == world.rooms.size());
    }
}

TEST_CASE("without obstacles, surfaces and their solids are as before, and no curve is left over") {
  World world = place("office");
  const World less = leave_out(world, {WorldPart::obstacles});
  CHECK(less.curves.size() == 1);
  CHECK(less.curves[0].id == 3);
  world.obstacles.clear(), world.curves.pop_back();
  CHECK(less == world);
}

TEST_CASE("a measured face keeps a solid when the inferred face that the solid was of goes") {
  const World world = wall_with_inferred_back(0.2);
  REQUIRE(std::all_of(world.colliders.begin(), world.colliders.end(),
                      [](const Collider& c) { return c.surface == 1; }));
  const World less = leave_out(world, {WorldPart::inferred});
  REQUIRE(less.colliders.size() == 1);
  CHECK(less.colliders[0].surface == 0);
  CHECK(std::get<OrientedBox>(less.colliders[0].shape).size.prod() ==
        doctest::Approx(4 * 2 * 0.2).epsilon(0.01));
  CHECK(leave_out(world, {WorldPart::inferred, WorldPart::colliders}).colliders.empty());
}

TEST_CASE("parts are told by name, and what is no part is told with all that are") {
  CHECK(parts_from("").empty());
  CHECK(parts_from("obstacles,inferred") == std::set{WorldPart::inferred, WorldPart::obstacles});
  CHECK(parts_from("obstacles,colliders,openings,surfaces,inferred").size() == 5);
  for (const char* wrong : {"walls", "obstacles,,colliders", "Obstacles", " "}) {
    const std::string told = error_of(Cause::usage, [&] { parts_from(wrong); });
    CHECK_MESSAGE(contains(told, "obstacles, colliders, openings, surfaces, inferred"), wrong);
  }
}
