// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/doubled.h"

#include "support/scenes.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// How much of these surfaces is doubled by points at the heights that `height` tells.
template <typename Height>
std::optional<double> doubled_by(const std::vector<FoundSurface>& surfaces, const Height& height) {
  Random random(4);
  const World world = world_with(surfaces);
  const RayScene scene(world);
  std::vector<Vec3> points;
  std::vector<std::optional<Nearest>> nearest;
  for (int i = 0; i < 40000; ++i) {
    const double x = random.uniform(0, 4), y = random.uniform(0, 4);
    points.emplace_back(x, y, height(x, y, i) + 0.003 * random.gauss());
    nearest.push_back(scene.nearest(points.back(), 0.5));
  }
  return measure_doubled(world, points, nearest);
}

const std::vector<FoundSurface> kFloor = {level_rectangle(0, 0, 4, 4, 0)};

}  // namespace

TEST_CASE("a surface whose points lie in two layers is doubled, whether it is one surface or two") {
  const auto twice = [](double, double, int i) { return i % 2 ? 0.025 : -0.025; };
  CHECK(*doubled_by(kFloor, twice) > 0.9);
  CHECK(*doubled_by({level_rectangle(0, 0, 4, 4, 0.025), level_rectangle(0, 0, 4, 4, -0.025)},
                    twice) > 0.9);
}

TEST_CASE("noise, steps and panels beside each other are not doubled") {
  Random random(5);
  CHECK(*doubled_by(kFloor, [](double, double, int) { return 0.0; }) < 0.01);
  CHECK(*doubled_by(kFloor, [&](double, double, int) { return 0.02 * random.gauss(); }) < 0.01);
  CHECK(*doubled_by(kFloor, [&](double, double, int) { return random.uniform(-0.09, 0.09); }) <
        0.05);
  CHECK(*doubled_by(kFloor, [](double x, double, int) { return x < 2 ? 0.0 : 0.03; }) < 0.01);
  CHECK(*doubled_by(kFloor, [](double x, double y, int) {
    return (static_cast<int>(x) + static_cast<int>(y)) % 2 * 0.02;
  }) < 0.05);
}

TEST_CASE("what has too few points tells nothing") {
  const World world = world_with(kFloor);
  CHECK_FALSE(measure_doubled(world, {{1, 1, 0}}, {Nearest{0, true, 0}}));
}
