// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/sight_lines.h"

#include "support/scenes.h"
#include "world/assemble.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

const Vec3 kY = Vec3::UnitY();

// A wall in the plane y = 0, from x = -2 to 2 and z = 0 to 3.
World wall() {
  return assemble_world(
      {{.plane = {kY, 0}, .outer = {{-2, 0, 0}, {-2, 0, 3}, {2, 0, 3}, {2, 0, 0}}}}, {});
}

SightLines follow(const std::vector<SeenPoint>& points, const std::vector<Vec3>& viewpoints) {
  const RayScene scene(wall());
  return follow_sight_lines(points, viewpoints, scene);
}

}  // namespace

TEST_CASE("a ray that ends at the wall is free and stops; one that goes through is a violation") {
  const SightLines on = follow({{{0, 0.01, 1}, kY}}, {{0, 3, 1}});
  CHECK(on.free_rays == 1);
  CHECK(on.violations.empty());
  CHECK(on.ending_rays == 1);
  CHECK(on.leaks.empty());
  const SightLines through = follow({{{0, -1, 1}, kY}}, {{0, 3, 1}});
  REQUIRE(through.violations.size() == 1);
  CHECK((through.violations[0].from - Vec3(0, 3, 1)).norm() < 1e-9);
  CHECK((through.violations[0].met - Vec3(0, 0, 1)).norm() < 1e-6);
  CHECK((through.violations[0].point - Vec3(0, -1, 1)).norm() < 1e-9);
  REQUIRE(through.leaks.size() == 1);  // nothing is at the point
  CHECK((through.leaks[0].point - Vec3(0, -1, 1)).norm() < 1e-9);
  const SightLines beside = follow({{{2.5, 0, 1}, kY}}, {{2.5, 3, 1}});
  CHECK(beside.violations.empty());
  CHECK(beside.leaks.size() == 1);
}

TEST_CASE("a wall 8 cm before a point is no violation, one 12 cm before it is") {
  CHECK(follow({{{0, -0.08, 1}, {}}}, {{0, 3, 1}}).violations.empty());
  CHECK(follow({{{0, -0.12, 1}, {}}}, {{0, 3, 1}}).violations.size() == 1);
  CHECK(follow({{{0, 0.18, 1}, kY}}, {{0, 3, 1}}).leaks.empty());  // it may be 20 cm behind
  CHECK(follow({{{0, 0.22, 1}, kY}}, {{0, 3, 1}}).leaks.size() == 1);
}

TEST_CASE("grazing rays, points without a surface and points at the scanner tell less") {
  const SightLines grazing = follow({{{1.9, 0, 1}, kY}}, {{-2, 0.5, 1}});
  CHECK(grazing.free_rays == 0);
  CHECK(grazing.ending_rays == 0);
  const SightLines clutter = follow({{{1, 1, 1}, {}}}, {{0, 3, 1}});
  CHECK(clutter.free_rays == 1);
  CHECK(clutter.ending_rays == 0);
  const SightLines close = follow({{{0, 0, 1}, kY}}, {{0, 0.2, 1}});
  CHECK(close.free_rays == 0);
  CHECK(close.ending_rays == 1);
  CHECK(follow({{{0, 3, 1}, {}}}, {{0, 3, 1}}).free_rays == 0);
  CHECK(follow({}, {{0, 3, 1}}).free_rays == 0);
}

TEST_CASE("a point beyond the wall of the nearest viewpoint was seen from another one") {
  // From the other side of the wall it is nearer.
  const std::vector<Vec3> viewpoints = {{0, 0.5, 1}, {0, -3, 1}};
  const SightLines seen = follow({{{0, -1, 1}, {}}}, viewpoints);
  CHECK(seen.free_rays == 1);
  CHECK(seen.violations.empty());
  // No viewpoint sees a point that is beyond the wall for all of them.
  CHECK(follow({{{0, -1, 1}, {}}}, {{0, 0.5, 1}, {1, 3, 1}, {-1, 3, 2}}).violations.size() == 1);
}

TEST_CASE("the ray of a point comes from its own viewpoint, not from one that sees it as well") {
  const std::vector<Vec3> viewpoints = {{0, 0.5, 1}, {0, -3, 1}};
  CHECK(follow({{{0, -1, 1}, {}, 1}}, viewpoints).violations.empty());
  const SightLines seen = follow({{{0, -1, 1}, {}, 0}}, viewpoints);
  REQUIRE(seen.violations.size() == 1);
  CHECK((seen.violations[0].from - viewpoints[0]).norm() < 1e-9);
}
