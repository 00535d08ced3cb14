// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/bend.h"

#include "support/scenes.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// A floor of 6 m by 6 m whose points are off it by what `height` says, and by noise.
template <typename Height>
double bend_of(double noise, const Height& height) {
  PointCloud cloud;
  Random random(7);
  add_rectangle(cloud, {0, 0, 0}, {6, 0, 0}, {0, 6, 0}, 0.04, noise, random);
  std::vector<Vec3> points;
  for (const Vec3f& p : cloud.points)
    points.push_back(p.cast<double>() + Vec3(0, 0, height(p.x(), p.y())));
  const World world = world_with({level_rectangle(0, 0, 6, 6, 0)});
  const RayScene scene(world);
  std::vector<std::optional<Nearest>> nearest;
  for (const Vec3& p : points) nearest.push_back(scene.nearest(p, 0.5));
  return measure_bend(world, points, nearest);
}

}  // namespace

TEST_CASE("what is flat has no bend, however noisy, tilted or misplaced") {
  for (const double noise : {0.0, 0.004, 0.012}) {
    INFO(noise);
    CHECK(bend_of(noise, [](double, double) { return 0.0; }) < 0.001);
    CHECK(bend_of(noise, [](double x, double y) { return 0.01 + 0.002 * x - 0.003 * y; }) < 0.001);
  }
}

TEST_CASE("waves longer than a square are bend, as large as they are") {
  const double amplitude = 0.008;
  for (const double noise : {0.0, 0.004}) {
    const double bend =
        bend_of(noise, [&](double x, double) { return amplitude * std::sin(2 * M_PI * x / 4); });
    CHECK(bend > 0.5 * amplitude);
    CHECK(bend < 1.2 * amplitude);
  }
}

TEST_CASE("two layers that are mixed everywhere are no bend") {
  int turn = 0;
  CHECK(bend_of(0.001, [&](double, double) { return ++turn % 2 ? 0.03 : -0.03; }) < 0.004);
}
