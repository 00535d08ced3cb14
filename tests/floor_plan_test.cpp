// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/floor_plan.h"

#include "support/clutter.h"
#include "turn.h"
#include "world/assemble.h"
#include "world/level.h"
#include "world/ray_scene.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

World read_named(const char* name) {
  return read_world(in_project(std::string("worlds/") + name + ".json"));
}

double area_of(const FloorPlan& plan, PlanCell state) {
  const auto count = std::count(plan.cells.begin(), plan.cells.end(), state);
  return static_cast<double>(count) * plan.grid.cell * plan.grid.cell;
}

// The share of places where two plans differ.
double share_that_differs(const FloorPlan& a, const FloorPlan& b) {
  Random random(8);
  const int places = 20000;
  int differ = 0;
  for (int k = 0; k < places; ++k) {
    const Vec2 share(random.uniform(), random.uniform());
    const Vec2 size =
        a.grid.cell * Vec2(static_cast<double>(a.grid.columns), static_cast<double>(a.grid.rows));
    const Vec2 p = a.grid.corner + share.cwiseProduct(size);
    differ += a.at(p) != b.at(p);
  }
  return static_cast<double>(differ) / places;
}

}  // namespace

TEST_CASE("an empty room is free from wall to wall, and its walls stand behind their faces") {
  World world = read_named("room");
  world.obstacles.clear();
  std::erase_if(world.surfaces, [](const Surface& s) { return s.id > 12; });  // what stands in it
  const FloorPlan plan = make_floor_plan(world);
  // 5 m by 4 m, and 0.1 m by 0.9 m in the doorway.
  CHECK(area_of(plan, PlanCell::free) == doctest::Approx(20.09).epsilon(1e-9).scale(0));
  for (const double y : {0.01, 1.5, 3.99}) {
    CHECK(plan.at({0.01, y}) == PlanCell::free);
    CHECK(plan.at({-0.01, y}) == PlanCell::occupied);
    CHECK(plan.at({-0.06, y}) == PlanCell::unknown);
  }
  CHECK(plan.at({5.07, 3}) == PlanCell::free);
  CHECK(plan.at({5.07, 2.47}) == PlanCell::unknown);
  CHECK(plan.at({-100, 0}) == PlanCell::unknown);
}

TEST_CASE(
    "over every free cell rays go up through the band, and level rays stop in occupied ones") {
  const FloorPlanOptions options;
  for (const char* name : {"room", "office", "stairs"}) {
    const World world = read_named(name);
    const FloorPlan plan = make_floor_plan(world, options);
    const RayScene scene(world);
    Random random(7);
    int free = 0, stopped = 0;
    for (int k = 0; k < 20000; ++k) {
      const auto i =
          static_cast<std::size_t>(random.uniform(0, static_cast<double>(plan.grid.size()) - 1));
      const Vec2 jitter(random.uniform(-0.499, 0.499), random.uniform(-0.499, 0.499));
      const Vec2 p = plan.grid.center(i) + jitter * plan.grid.cell;
      const double height = plan.level + random.uniform(options.low + 1e-4, options.high - 1e-4);
      if (plan.cells[i] == PlanCell::free) {
        ++free;
        CHECK(scene.is_free({p.x(), p.y(), plan.level + options.low + 1e-4},
                            {p.x(), p.y(), plan.level + options.high - 1e-4}));
      }
      // What a level ray meets is in an occupied cell.
      const double angle = random.uniform(0, 2 * M_PI);
      const Vec3 from(p.x(), p.y(), height), way(std::cos(angle), std::sin(angle), 0);
      if (const auto hit = scene.cast(from, way)) {
        ++stopped;
        const Vec3 at = from + hit->distance * way;
        bool is_near = false;  // rays are of single precision, and hit lines between cells
        for (const double dx : {-1e-4, 0.0, 1e-4})
          for (const double dy : {-1e-4, 0.0, 1e-4})
            is_near |= plan.at({at.x() + dx, at.y() + dy}) == PlanCell::occupied;
        CHECK(is_near);
      }
    }
    CHECK(free > 1000);
    CHECK(stopped > 1000);
  }
}

TEST_CASE("solid obstacles are filled, and those under or over the band are not in the way") {
  World world = floor_world();
  world.obstacles = {{0, Cylinder{{0, 0, 1}, 1, 2}},
                     {1, OrientedBox{{3, 3, 1.0}, {1, 2, 2}, Eigen::Quaterniond::Identity()}},
                     {2, OrientedBox{{-3, 3, 0.04}, {1, 1, 0.08}, Eigen::Quaterniond::Identity()}},
                     {3, OrientedBox{{-3, -3, 2.5}, {1, 1, 1}, Eigen::Quaterniond::Identity()}}};
  const FloorPlan plan = make_floor_plan(world);
  CHECK(area_of(plan, PlanCell::occupied) == doctest::Approx(M_PI + 2).epsilon(0.08));
  CHECK(plan.at({0, 0}) == PlanCell::occupied);
  CHECK(plan.at({2.51, 2.01}) == PlanCell::occupied);
  CHECK(plan.at({2.49, 2.01}) == PlanCell::free);
  CHECK(plan.at({-3, 3}) == PlanCell::free);
  CHECK(plan.at({-3, -3}) == PlanCell::free);
  CHECK(area_of(plan, PlanCell::unknown) + 100 ==
        doctest::Approx(static_cast<double>(plan.grid.size()) * 0.0025));
}

TEST_CASE("a pane of glass is in the way, an opening without one is not") {
  World world = read_named("office");
  REQUIRE(world.openings[0].kind == OpeningKind::door);
  Vec3 middle = Vec3::Zero();
  for (int v : world.openings[0].loop) middle += world.vertices[static_cast<std::size_t>(v)] / 4;
  const auto is_blocked = [&](bool open_glass = false) {
    const FloorPlan plan = make_floor_plan(world, {.open_glass = open_glass});
    bool blocked = false;
    for (const double d : {-0.03, 0.03})
      blocked |= plan.at({middle.x(), middle.y() + d}) == PlanCell::occupied;
    return blocked;
  };
  CHECK_FALSE(is_blocked());
  world.openings[0].glass = true;
  CHECK(is_blocked());
  CHECK_FALSE(is_blocked(true));
}

TEST_CASE("colliders make walls solid") {
  World world = floor_world();
  world.colliders = {
      {world.surfaces[0].id, OrientedBox{{1, 1, 1}, {1, 1, 2}, Eigen::Quaterniond::Identity()}}};
  const FloorPlan plan = make_floor_plan(world);
  CHECK(area_of(plan, PlanCell::occupied) == doctest::Approx(1).epsilon(1e-9).scale(0));
}

TEST_CASE("a ramp is free while it is low, and in the way where it is high") {
  const FloorPlan plan = make_floor_plan(read_named("stairs"));
  CHECK(plan.at({9.4, 1.8}) == PlanCell::free);  // 4 cm up
  CHECK(plan.at({10.5, 1.8}) == PlanCell::occupied);
}

TEST_CASE("a tilted world has the plan of the upright one") {
  const World world = read_named("office");
  const FloorPlan upright = make_floor_plan(world);
  CHECK(upright.upright.coeffs() == Eigen::Quaterniond::Identity().coeffs());
  const Vec3 up = Vec3(0.2, -0.1, 1).normalized();
  const Eigen::Quaterniond tilt = turn_between(Vec3::UnitZ(), up);
  const World tilted = moved(world, tilt, Vec3::Zero());
  const FloorPlan plan = make_floor_plan(tilted);
  // Turned back, walls are on the lines between cells only nearly.
  const Vec2 off = plan.grid.corner - upright.grid.corner;
  CHECK(off.cwiseAbs().maxCoeff() < 0.051);
  CHECK(area_of(plan, PlanCell::free) ==
        doctest::Approx(area_of(upright, PlanCell::free)).epsilon(0.03));
  CHECK((plan.upright * up - Vec3::UnitZ()).norm() < 1e-9);
  // And made level again, the same cells to within those on lines.
  const FloorPlan levelled = make_floor_plan(level_world(tilted, {.level = true}));
  CHECK(share_that_differs(levelled, plan) < 0.02);
}

TEST_CASE("worlds without a floor have plans that know no free cell") {
  const FloorPlan nothing = make_floor_plan({});
  CHECK(nothing.cells == std::vector<PlanCell>{PlanCell::unknown});
  World wall = small_world();
  wall.surfaces.erase(wall.surfaces.begin());
  const FloorPlan plan = make_floor_plan(wall);
  CHECK(area_of(plan, PlanCell::free) == 0);
  CHECK(area_of(plan, PlanCell::occupied) == doctest::Approx(4 * 0.05).epsilon(1e-9).scale(0));
}

TEST_CASE("a plan that would be too large is refused, and the number is named") {
  const World wide = scaled(small_world(), 1250);
  const std::string text = error_of(Cause::usage, [&] { make_floor_plan(wide); });
  CHECK(contains(text, "5000 m by 3750 m"));
  CHECK(contains(text, "cells of 0.05 m"));
  const FloorPlan coarse = make_floor_plan(wide, {.cell = 5});
  CHECK(coarse.grid.size() < 1000 * 800);
}
