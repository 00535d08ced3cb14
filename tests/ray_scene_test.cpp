// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/ray_scene.h"

#include "support/scenes.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// The distance of a point from a rectangle of a plane y = 0 or z = 0, written down as it is.
double to_rectangle(double u, double v, double off, double width, double height) {
  const double du = std::max({0.0, -u, u - width}), dv = std::max({0.0, -v, v - height});
  return std::sqrt(du * du + dv * dv + off * off);
}

}  // namespace

TEST_CASE("the nearest surface and its distance are right all around, near holes too") {
  const RayScene scene(small_world());  // a floor of 4 x 3, a wall of 4 x 2.5 with a window
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p(random.uniform(-2, 6), random.uniform(-2, 5), random.uniform(-2, 5));
    const double floor = to_rectangle(p.x(), p.y(), p.z(), 4, 3);
    double wall = to_rectangle(p.x(), p.z(), p.y(), 4, 2.5);
    if (p.x() > 1 && p.x() < 2 && p.z() > 1 && p.z() < 2) {  // before the window
      const double edge = std::min({p.x() - 1, 2 - p.x(), p.z() - 1, 2 - p.z()});
      wall = std::hypot(edge, p.y());
    }
    const auto nearest = scene.nearest(p, 100);
    REQUIRE(nearest);
    CHECK(nearest->is_surface);
    CHECK(nearest->distance == doctest::Approx(std::min(floor, wall)).scale(0).epsilon(1e-9));
    if (std::abs(floor - wall) > 1e-9) CHECK(nearest->index == (floor < wall ? 0 : 1));
    CHECK_FALSE(scene.nearest(p, 0.999 * nearest->distance));
    CHECK(scene.nearest(p, 1.001 * nearest->distance));
  }
}

TEST_CASE("of surfaces that are equally near the first is taken; obstacles have a skin") {
  World world = small_world();
  const RayScene corner(world);
  for (double x : {0.3, 1.7, 3.9}) CHECK(corner.nearest({x, -0.5, -0.5}, 2)->index == 0);
  world.obstacles.push_back({.shape = OrientedBox{{2, 1.5, 1}, {1, 1, 1}}});
  const RayScene scene(world);
  const auto inside = scene.nearest({2, 1.5, 1.3}, 2);
  REQUIRE(inside);
  CHECK_FALSE(inside->is_surface);
  CHECK(inside->distance == doctest::Approx(0.2));
  CHECK_FALSE(RayScene({}).nearest({0, 0, 0}, 10));
}

TEST_CASE("a way is free where no ray along it meets anything") {
  const World world = full_world();
  const RayScene scene(world);
  Random random(2);
  int blocked = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a(random.uniform(-1, 5), random.uniform(-1, 4), random.uniform(-1, 3)),
        b(random.uniform(-1, 5), random.uniform(-1, 4), random.uniform(-1, 3));
    const bool met = scene.cast(a, (b - a).normalized(), (b - a).norm()).has_value();
    CHECK(scene.is_free(a, b) == !met);
    blocked += met;
  }
  CHECK(blocked > 200);
  CHECK(blocked < 1800);
}
