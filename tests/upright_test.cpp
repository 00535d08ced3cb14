// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/upright.h"

#include "support/scenes.h"
#include "world/level.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

double length_of(const std::vector<WallCut>& cuts) {
  double sum = 0;
  for (const WallCut& c : cuts) sum += (c.b - c.a).norm();
  return sum;
}

}  // namespace

TEST_CASE("a cut through walls is as long as they are, but for their openings") {
  const World world = small_world();  // a floor, and a wall with a window
  const Upright upright(world);
  const Box3 box = bounds(world);
  const double above = box.max().z() - 1e-3, through = box.center().z();
  CHECK(length_of(cut_at(above, upright)) == doctest::Approx(box.sizes().head<2>().maxCoeff()));
  CHECK(length_of(cut_at(through, upright)) < length_of(cut_at(above, upright)) - 0.1);
  CHECK(cut_at(box.max().z() + 1, upright).empty());
}

TEST_CASE("the front of a cut is on the free side of its surface") {
  const World world = read_world(in_project("worlds/office.json"));
  for (const WallCut& c : cut_at(1.3, Upright(world))) {
    const Plane& plane = world.surfaces[c.surface].plane;
    const Vec2 at = (c.a + c.b) / 2 + 0.1 * c.front;
    CHECK(plane.signed_distance({at.x(), at.y(), 1.3}) > 0.05);
  }
}

TEST_CASE("a world that is tilted is cut as if it stood upright") {
  const World world = read_world(in_project("worlds/office.json"));
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(0.2, Vec3(1, 2, 0).normalized()));
  const Upright straight(world), tilted(moved(world, tilt, Vec3::Zero()));
  CHECK((tilted.turn * tilt * Vec3::UnitZ() - Vec3::UnitZ()).norm() < 1e-9);
  CHECK(length_of(cut_at(1.3, tilted)) ==
        doctest::Approx(length_of(cut_at(1.3, straight))).epsilon(1e-5));
}
