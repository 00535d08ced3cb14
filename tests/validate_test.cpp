// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/validate.h"

#include "support/scenes.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// The first reason of a world that was changed, or "" where it is valid.
template <typename Change>
std::string reason(Change change) {
  World world = full_world();
  change(world);
  const auto reasons = validate(world);
  return reasons.empty() ? "" : reasons[0];
}

}  // namespace

TEST_CASE("worlds without fault are valid") {
  CHECK(validate({}).empty());
  CHECK(validate(small_world()).empty());
  CHECK(reason([](World&) {}) == "");
  for (const char* name : {"room", "office", "stairs"})
    CHECK(validate(read_world(in_project(std::string("worlds/") + name + ".json"))).empty());
}

TEST_CASE("each fault is found and named") {
  CHECK(contains(reason([](World& w) { w.frame.up = {0, 0, 2}; }), "up is not of length 1"));
  CHECK(contains(reason([](World& w) { w.vertices[2].x() = NAN; }), "vertex 2 is not finite"));
  CHECK(
      contains(reason([](World& w) { w.surfaces[1].id = 0; }), "surface 0: the id is there twice"));
  CHECK(contains(reason([](World& w) { w.surfaces[0].id = -4; }), "negative"));
  CHECK(contains(reason([](World& w) { w.surfaces[0].plane.normal *= 1.01; }),
                 "normal is not of length 1"));
  CHECK(contains(reason([](World& w) { w.surfaces[0].outer.resize(2); }), "2 vertices"));
  CHECK(contains(reason([](World& w) { w.surfaces[0].outer[1] = 99; }), "vertex 99"));
  CHECK(contains(reason([](World& w) { w.surfaces[0].outer[1] = -1; }), "vertex -1"));
  CHECK(
      contains(reason([](World& w) { w.surfaces[0].outer[1] = w.surfaces[0].outer[0]; }), "twice"));
  CHECK(contains(reason([](World& w) { w.vertices[2].z() += 0.01; }), "off the plane"));
  CHECK(contains(reason([](World& w) {
                   std::reverse(w.surfaces[0].outer.begin(), w.surfaces[0].outer.end());
                 }),
                 "not counter-clockwise"));
  CHECK(contains(reason([](World& w) {
                   std::reverse(w.surfaces[1].holes[0].begin(), w.surfaces[1].holes[0].end());
                 }),
                 "hole 0 is not clockwise"));
  CHECK(
      contains(reason([](World& w) { std::swap(w.surfaces[0].outer[0], w.surfaces[0].outer[1]); }),
               "surface 0"));
  CHECK(contains(reason([](World& w) {
                   w.vertices[static_cast<std::size_t>(w.surfaces[1].holes[0][0])].x() = -5;
                 }),
                 "surface 1"));
  CHECK(contains(reason([](World& w) { w.surfaces[1].thickness = 0; }), "thickness"));
  CHECK(contains(reason([](World& w) { w.surfaces[1].support.coverage = 1.5; }), "coverage"));
  CHECK(contains(reason([](World& w) { w.openings[0].surface = 5; }), "no surface 5"));
  CHECK(contains(reason([](World& w) { w.openings[0].width = 0; }), "not positive"));
  CHECK(contains(reason([](World& w) { w.openings[0].loop[0] = 2; }), "opening 7"));
  CHECK(contains(reason([](World& w) { std::get<OrientedBox>(w.obstacles[0].shape).size.y() = 0; }),
                 "obstacle 0"));
  CHECK(contains(
      reason([](World& w) { std::get<OrientedBox>(w.obstacles[0].shape).rotation.w() = 9; }),
      "rotation"));
  CHECK(contains(
      reason([](World& w) { std::get<ConvexHull>(w.obstacles[1].shape).vertices.resize(3); }),
      "3 vertices"));
  CHECK(contains(reason([](World& w) { std::get<Cylinder>(w.obstacles[2].shape).radius = -1; }),
                 "obstacle 2"));
  CHECK(contains(reason([](World& w) { w.surfaces[0].curve = 9; }), "there is no curve 9"));
  CHECK(contains(reason([](World& w) { w.obstacles[0].curve = 8; }), "there is no curve 8"));
  CHECK(contains(reason([](World& w) { w.curves[1].id = 4; }), "curve 4"));
  CHECK(contains(reason([](World& w) { w.curves[0].curve.shape.axis *= 2; }),
                 "curve 4: the axis is not of length 1"));
  CHECK(contains(reason([](World& w) { w.curves[0].curve.start = Vec3::UnitZ(); }),
                 "curve 4: the start"));
  CHECK(contains(reason([](World& w) { w.curves[1].curve.shape.radius = NAN; }), "radius"));
  CHECK(contains(reason([](World& w) { w.curves[1].curve.high = -1; }), "extent"));
  CHECK(contains(reason([](World& w) { w.curves[2].curve.shape.half_angle = 1.6; }), "half angle"));
  CHECK(contains(reason([](World& w) { w.curves[2].curve.low = -0.1; }), "before the apex"));
  CHECK(contains(reason([](World& w) { w.curves[1].curve.sweep = 7; }), "sweep"));
  CHECK(contains(reason([](World& w) { w.colliders[1].surface = 8; }),
                 "collider 1: there is no surface 8"));
  CHECK(contains(
      reason([](World& w) { std::get<ConvexPrism>(w.colliders[1].shape).extrusion.setZero(); }),
      "extrusion"));
  const auto prism = [](World& w) -> ConvexPrism& {
    return std::get<ConvexPrism>(w.colliders[1].shape);
  };
  CHECK(contains(reason([&](World& w) { prism(w).extrusion = {1, 0, 0}; }), "lies in the base"));
  CHECK(contains(reason([&](World& w) { prism(w).base.resize(2); }), "the base has 2 vertices"));
  CHECK(contains(reason([&](World& w) { prism(w).base[2] = {2, 0, 0}; }), "no area"));
  CHECK(contains(reason([&](World& w) { prism(w).base.push_back({2, 0, 0.2}); }), "not convex"));
  CHECK(contains(reason([&](World& w) { prism(w).base.push_back({0, 0.1, 1}); }), "off its plane"));
  CHECK(contains(reason([](World& w) { w.rooms[0].surfaces.push_back(12); }),
                 "room 0: there is no surface 12"));
  CHECK(contains(reason([](World& w) { w.doors[0].rooms[1] = 4; }), "no room 4"));
  CHECK(contains(reason([](World& w) { w.doors[0].opening = 3; }), "no opening 3"));
  CHECK(contains(reason([](World& w) { w.openings[0].leaf->surface = 9; }),
                 "opening 7: the leaf: there is no surface 9"));
  CHECK(contains(reason([](World& w) { w.openings[0].leaf->angle = 4; }), "the leaf's angle 4"));
  CHECK(
      contains(reason([](World& w) { w.ways[0].floors[0] = 9; }), "way 3: there is no surface 9"));
  CHECK(contains(reason([](World& w) { w.ways[0].rooms[1] = 9; }), "way 3: there is no room 9"));
  CHECK(contains(reason([](World& w) { w.ways[0].steps = 1; }), "way 3: stairs of 1 steps"));
  CHECK(contains(reason([](World& w) { w.ways[0].top.z() = -1; }), "way 3: the rise"));
  CHECK(contains(reason([](World& w) { w.ways[1].slope = 0; }), "way 4: the slope"));
  CHECK(contains(reason([](World& w) { w.ways[1].id = 3; }), "way 3: the id is there twice"));
}

TEST_CASE("worlds broken at random never crash the check") {
  Random random(1);
  for (int round = 0; round < 3000; ++round) {
    World world = full_world();
    for (int i = 0; i < random.whole(1, 4); ++i) {
      Surface& s = world.surfaces[static_cast<std::size_t>(random.whole(0, 1))];
      switch (random.whole(0, 6)) {
        case 0:
          s.outer[static_cast<std::size_t>(random.whole(0, static_cast<int>(s.outer.size()) - 1))] =
              random.whole(-2, 15);
          break;
        case 1:
          if (s.outer.size() > 1) s.outer.pop_back();
          break;
        case 2:
          world.vertices[static_cast<std::size_t>(random.whole(0, 9))] = random.direction() * 3;
          break;
        case 3:
          world.vertices[static_cast<std::size_t>(random.whole(0, 9))].y() = NAN;
          break;
        case 4:
          s.holes.push_back(s.outer);
          break;
        case 5:
          s.plane.normal = random.direction() * random.uniform(0, 2);
          break;
        default:
          world.vertices.resize(static_cast<std::size_t>(random.whole(10, 12)), Vec3::Zero());
      }
    }
    validate(world);
  }
}
