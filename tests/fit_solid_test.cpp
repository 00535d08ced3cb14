// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/fit_solid.h"

#include "support/clutter.h"
#include "world/solids.h"
#include "world/validate.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

const Vec3 kUp = Vec3::UnitZ();

doctest::Approx about(double value, double off) {
  return doctest::Approx(value).epsilon(off).scale(0);
}

// Valid in a world of its own.
bool is_valid(const Solid& solid) {
  World world = floor_world();
  world.obstacles = {{0, solid}};
  return validate(world).empty();
}

}  // namespace

TEST_CASE("a drum is a cylinder, to a centimetre, from all sides or one") {
  Random random(1);
  for (double radius : {0.15, 0.3, 0.6})
    for (double arc : {7.0, 3.0}) {
      CAPTURE(radius);
      CAPTURE(arc);
      const Vec3 center(random.uniform(-9, 9), random.uniform(-9, 9), 0.5);
      std::vector<Vec3> points;
      add_drum(points, center, radius, 1, kThingSpacing, kNoise, random, random.uniform(0, 6), arc);
      const Solid solid = fit_solid(points, kUp, kNoise);
      REQUIRE(std::holds_alternative<Cylinder>(solid));
      const auto& c = std::get<Cylinder>(solid);
      CHECK((c.center - center).head<2>().norm() < 0.01);
      CHECK(std::abs(c.radius - radius) < 0.01);
      CHECK(std::abs(c.center.z() + c.height / 2 - 1) < 0.01);
      CHECK(std::abs(c.center.z() - c.height / 2) < 0.02);
    }
}

TEST_CASE("a crate is a box, to a centimetre, at any angle") {
  Random random(2);
  for (int k = 0; k < 12; ++k) {
    const Vec3 size(random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1.5)),
        center(random.uniform(-9, 9), random.uniform(-9, 9), size.z() / 2);
    const double angle = random.uniform(0, M_PI);
    CAPTURE(size.transpose());
    CAPTURE(angle);
    std::vector<Vec3> points;
    add_crate(points, center, size, angle, kThingSpacing, kNoise, random);
    const Solid solid = fit_solid(points, kUp, kNoise);
    REQUIRE(std::holds_alternative<OrientedBox>(solid));
    const auto& box = std::get<OrientedBox>(solid);
    CHECK((box.center - center).norm() < 0.015);
    CHECK(box.size.prod() == about(size.prod(), 0.08));
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      const Vec3 true_corner =
          center + Eigen::AngleAxisd(angle, kUp) * Vec3(sign.cwiseProduct(size) / 2);
      CHECK(std::abs(outside_of({0, box}, {}, true_corner)) < 0.02);
    }
  }
}

TEST_CASE("a ball is one hull of at most 32 vertices, as large as the ball, near all its points") {
  Random random(3);
  for (double radius : {0.15, 0.3, 0.5})
    for (double noise : {0.002, 0.01}) {
      CAPTURE(radius);
      CAPTURE(noise);
      std::vector<Vec3> points;
      add_ball(points, {1, 2, 3}, radius, kThingSpacing, noise, random);
      const Solid solid = fit_solid(points, kUp, noise);
      REQUIRE(std::holds_alternative<ConvexHull>(solid));
      const auto& hull = std::get<ConvexHull>(solid);
      CHECK(hull.vertices.size() <= 32);
      CHECK(volume_of(mesh_of(hull)) == about(4.0 / 3 * M_PI * std::pow(radius, 3), 0.25));
      for (const Vec3& v : hull.vertices) CHECK((v - Vec3(1, 2, 3)).norm() < radius + 2 * noise);
      for (const Vec3& p : points) CHECK(outside_of({0, hull}, {}, p) < 0.12 * radius + 4 * noise);
    }
}

TEST_CASE("points in a plane or a line have a valid solid, thin as they are") {
  Random random(4);
  for (int dimensions : {1, 2})
    for (double noise : {0.0, 0.004}) {
      CAPTURE(dimensions);
      std::vector<Vec3> points;
      const Vec3 a = random.direction(), b = a.unitOrthogonal();
      for (int i = 0; i < 300; ++i)
        points.push_back(random.uniform() * a + (dimensions - 1) * random.uniform() * b +
                         noise * random.gauss() * random.direction());
      const Solid solid = fit_solid(points, kUp, noise);
      CHECK(is_valid(solid));
      CHECK(volume_of(mesh_of({0, solid}, {})) < 0.05);
      for (const Vec3& p : points) CHECK(outside_of({0, solid}, {}, p) < 0.06);
    }
}
