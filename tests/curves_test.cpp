// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/curves.h"

#include <algorithm>

#include "parallel.h"
#include "rival/curve_points.h"
#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

constexpr double kCurveNoise = 0.004;

// A part of the side of a cylinder about an axis from `foot` along `axis` (its length is the
// height), or with a slope [rad] of a cone that gets narrower.
void add_round(PointCloud& cloud, const Vec3& foot, const Vec3& axis, double radius, double sweep,
               double spacing, double noise, Random& random, double slope = 0) {
  const PlaneFrame frame = frame_of({axis.normalized(), 0});
  const double height = axis.norm();
  const int count = static_cast<int>(sweep * radius * height / (spacing * spacing));
  for (int i = 0; i < count; ++i) {
    const double angle = random.uniform(0, sweep), h = random.uniform(0, height);
    const Vec3 out = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
    const double r = radius - h * std::tan(slope);
    const Vec3 normal = std::cos(slope) * out + std::sin(slope) * axis.normalized();
    cloud.points.push_back(
        (foot + h * axis.normalized() + r * out + noise * random.gauss() * normal).cast<float>());
  }
}

// The upper half of a sphere, or less of it.
void add_dome(PointCloud& cloud, const Vec3& middle, double radius, double lowest, double spacing,
              double noise, Random& random) {
  const int count = static_cast<int>(2 * M_PI * radius * (radius - lowest) / (spacing * spacing));
  for (int i = 0; i < count; ++i) {
    const double angle = random.uniform(0, 2 * M_PI), h = random.uniform(lowest, radius) / radius;
    const double out = std::sqrt(1 - h * h);
    const Vec3 normal(out * std::cos(angle), out * std::sin(angle), h);
    cloud.points.push_back((middle + (radius + noise * random.gauss()) * normal).cast<float>());
  }
}

Curves curves_of(const Stages& s) {
  return find_curves(s.grid, s.neighbors, s.scale, s.local, s.grow(), s.options.curves);
}

Curves curves_of(PointCloud cloud) { return curves_of(run_stages(std::move(cloud))); }

double angle_between(const Vec3& a, const Vec3& b) {
  return std::acos(std::min(std::abs(a.normalized().dot(b.normalized())), 1.0));
}

// A wall of 8 x 3 m, bowed by so much in its middle.
PointCloud bowed_wall(double bow, double noise) {
  PointCloud cloud;
  Random random(3);
  for (double x = 0; x < 8; x += 0.02)
    for (double z = 0; z < 3; z += 0.02)
      cloud.points.emplace_back(
          Vec3(x, bow * std::sin(M_PI * x / 8) + noise * random.gauss(), z).cast<float>());
  return cloud;
}

}  // namespace

TEST_CASE("a column in a room is a cylinder with its axis, radius and height") {
  Random random(1);
  for (double radius : {0.15, 0.3, 0.6}) {
    CAPTURE(radius);
    PointCloud cloud = room_points({5, 4, 2.8}, 0.02, kCurveNoise);
    add_round(cloud, {2.2, 1.9, 0}, {0, 0, 2.8}, radius, 2 * M_PI, 0.015, kCurveNoise, random);
    const Curves found = curves_of(std::move(cloud));
    REQUIRE(found.curves.size() == 1);
    const Curve& c = found.curves[0];
    CHECK(c.shape.type == CurveType::cylinder);
    CHECK(c.shape.radius == doctest::Approx(radius).epsilon(0.02));
    CHECK(angle_between(c.shape.axis, Vec3::UnitZ()) < 0.01);
    CHECK(c.shape.way_to(Vec3(2.2, 1.9, 1)).norm() < 0.01);
    CHECK(c.high - c.low == doctest::Approx(2.8).epsilon(0.05));
    CHECK(c.sweep == doctest::Approx(2 * M_PI));
    CHECK_FALSE(c.hollow);
    CHECK(c.support.rms < 1.3 * kCurveNoise);
  }
}

TEST_CASE("a pipe may lie askew, and half of a column is enough") {
  Random random(2);
  PointCloud cloud;
  add_rectangle(cloud, {0, 0, 0}, {5, 0, 0}, {0, 4, 0}, 0.02, kCurveNoise, random);
  const Vec3 askew(3, 1.5, 0.8);
  add_round(cloud, {0.5, 0.5, 1}, askew, 0.2, 2 * M_PI, 0.015, kCurveNoise, random);
  add_round(cloud, {4, 1, 0}, {0, 0, 2.5}, 0.3, M_PI, 0.015, kCurveNoise, random);
  Curves found = curves_of(std::move(cloud));
  REQUIRE(found.curves.size() == 2);
  std::sort(found.curves.begin(), found.curves.end(),
            [](const Curve& a, const Curve& b) { return a.shape.radius < b.shape.radius; });
  CHECK(found.curves[0].shape.radius == doctest::Approx(0.2).epsilon(0.03));
  CHECK(angle_between(found.curves[0].shape.axis, askew) < 0.01);
  CHECK(found.curves[1].shape.radius == doctest::Approx(0.3).epsilon(0.04));
  CHECK(found.curves[1].sweep == doctest::Approx(M_PI).epsilon(0.1));
}

TEST_CASE("a barrel vault on walls is one cylinder, seen from inside") {
  Random random(4);
  for (double radius : {1.5, 3.0}) {
    CAPTURE(radius);
    PointCloud cloud;
    const double wide = 2 * radius;
    add_rectangle(cloud, {0, 0, 0}, {6, 0, 0}, {0, wide, 0}, 0.03, kCurveNoise, random);
    add_rectangle(cloud, {0, 0, 0}, {6, 0, 0}, {0, 0, 2}, 0.03, kCurveNoise, random);
    add_rectangle(cloud, {0, wide, 0}, {6, 0, 0}, {0, 0, 2}, 0.03, kCurveNoise, random);
    PointCloud vault;
    add_round(vault, {0, radius, 2}, {6, 0, 0}, radius, 2 * M_PI, 0.03, kCurveNoise, random);
    for (const auto& p : vault.points)
      if (p.z() > 2) cloud.points.push_back(p);
    const Stages s = run_stages(std::move(cloud));
    const Curves found = curves_of(s);
    REQUIRE(found.curves.size() == 1);
    const Curve& c = found.curves[0];
    CHECK(c.shape.type == CurveType::cylinder);
    CHECK(c.shape.radius == doctest::Approx(radius).epsilon(0.01));
    CHECK(angle_between(c.shape.axis, Vec3::UnitX()) < 0.01);
    CHECK(c.sweep == doctest::Approx(M_PI).epsilon(0.08));
    // The walls and the floor are none of it, though the walls touch it.
    const std::vector<std::int32_t> labels =
        label_curve_points(s.cloud, s.grid, s.scale, found, s.options.curves);
    std::size_t right = 0, wrong = 0, all = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const float z = s.cloud.points[i].z();
      all += z > 2.05f, right += z > 2.05f && labels[i] == 0, wrong += z < 1.7f && labels[i] == 0;
    }
    CHECK(static_cast<double>(right) > 0.9 * static_cast<double>(all));
    CHECK(wrong == 0);
  }
}

TEST_CASE("a dome is a sphere") {
  Random random(5);
  for (double radius : {1.5, 3.0}) {
    CAPTURE(radius);
    PointCloud cloud;
    add_rectangle(cloud, {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, 0.04, kCurveNoise, random);
    add_dome(cloud, {0.3, -0.2, 2}, radius, 0, 0.03, kCurveNoise, random);
    const Curves found = curves_of(std::move(cloud));
    REQUIRE(found.curves.size() == 1);
    const Curve& c = found.curves[0];
    CHECK(c.shape.type == CurveType::sphere);
    CHECK(c.shape.radius == doctest::Approx(radius).epsilon(0.01));
    CHECK((c.shape.point - Vec3(0.3, -0.2, 2)).norm() < 0.02);
  }
}

TEST_CASE("rooms, pillars, corners and edges are not round, however noisy") {
  Random random(6);
  for (double noise : {0.002, 0.01, 0.02}) {
    CAPTURE(noise);
    PointCloud cloud = room_points({5, 4, 2.8}, 0.025, noise);
    for (int side = 0; side < 8; ++side) {  // an octagon of 0.5 m, as wide as a column
      const double a = side * M_PI / 4, b = a + M_PI / 4;
      const Vec3 from(0.5 * std::cos(a), 0.5 * std::sin(a), 0),
          to(0.5 * std::cos(b), 0.5 * std::sin(b), 0);
      if (noise < 0.01)
        add_rectangle(cloud, Vec3(1.5, 2, 0) + from, to - from, {0, 0, 2.8}, 0.015, noise, random);
    }
    for (const Vec3& a : {Vec3(0.5, 0, 0), Vec3(0, 0.5, 0)})  // and a square pillar
      for (const Vec3& at : {Vec3(3.5, 1, 0), Vec3(4, 1.5, 0)})
        add_rectangle(cloud, at, at.x() < 3.8 ? a : Vec3(-a), {0, 0, 2.8}, 0.015, noise, random);
    CHECK(curves_of(std::move(cloud)).curves.empty());
  }
}

TEST_CASE(
    "a tapered column, a funnel and a conical roof are cones with their apex and half angle") {
  struct Sample {
    Vec3 foot, axis;
    double radius, slope, sweep;
  };
  const Sample samples[] = {
      {{2.2, 1.9, 0}, {0, 0, 2.8}, 0.5, 0.05, 2 * M_PI},
      {{2.2, 1.9, 0.4}, {0, 0, 1.2}, 0.8, 0.5, M_PI},
      {{2.2, 1.9, 2.6}, {0, 0, 2}, 2.5, 0.8, 2 * M_PI},
  };
  Random random(9);
  for (const Sample& s : samples) {
    CAPTURE(s.slope);
    PointCloud cloud;
    add_rectangle(cloud, {-1, -1, 0}, {6, 0, 0}, {0, 6, 0}, 0.02, kCurveNoise, random);
    add_round(cloud, s.foot, s.axis, s.radius, s.sweep, 0.015, kCurveNoise, random, s.slope);
    const Curves found = curves_of(std::move(cloud));
    // The rim of a wide roof may be taken for a part of a sphere.
    REQUIRE(!found.curves.empty());
    REQUIRE(found.curves.size() <= (s.slope < 0.7 ? 1 : 2));
    const Curve& c = *std::ranges::max_element(
        found.curves, {}, [](const Curve& curve) { return curve.support.points; });
    CHECK(c.shape.type == CurveType::cone);
    CHECK(c.shape.radius == 0);
    CHECK(c.shape.half_angle == doctest::Approx(s.slope).epsilon(0.05));
    const Vec3 apex = s.foot + s.axis.normalized() * (s.radius / std::tan(s.slope));
    CHECK((c.shape.point - apex).norm() < 0.05 * s.radius / std::tan(s.slope));
    CHECK(angle_between(c.shape.axis, s.axis) < 0.02);
    CHECK(c.support.rms < 1.3 * kCurveNoise);
    CHECK(c.low >= 0);
  }
}

TEST_CASE("cylinders, discs and pyramids are no cones") {
  Random random(10);
  PointCloud cloud;
  add_rectangle(cloud, {-1, -1, 0}, {6, 0, 0}, {0, 6, 0}, 0.02, kCurveNoise, random);
  add_round(cloud, {1, 1, 0}, {0, 0, 2.5}, 0.3, M_PI, 0.015, kCurveNoise, random);
  for (int i = 0; i < 15000; ++i) {  // a disc, a little tilted
    const double r = 0.8 * std::sqrt(random.uniform()), a = random.uniform(0, 2 * M_PI);
    const Vec3 p(3 + r * std::cos(a), 3 + r * std::sin(a), 1 + 0.1 * r * std::cos(a));
    cloud.points.push_back((p + Vec3(0, 0, kCurveNoise * random.gauss())).cast<float>());
  }
  for (int side = 0; side < 4; ++side) {  // a pyramid
    const double a = side * M_PI / 2, b = a + M_PI / 2;
    const Vec3 from(std::cos(a), std::sin(a), 0), to(std::cos(b), std::sin(b), 0);
    for (int i = 0; i < 8000; ++i) {
      double u = random.uniform(), v = random.uniform();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 p = Vec3(1, 4, 0) + u * from + v * to + (1 - u - v) * Vec3(0, 0, 1.5);
      cloud.points.push_back((p + kCurveNoise * random.gauss() * Vec3::UnitZ()).cast<float>());
    }
  }
  for (const Curve& c : curves_of(std::move(cloud)).curves)
    CHECK(c.shape.type == CurveType::cylinder);
}

TEST_CASE("a bowed wall is a wall") {
  for (double bow : {0.0, 0.02, 0.05, 0.1}) {
    CAPTURE(bow);
    CHECK(curves_of(bowed_wall(bow, 0.003)).curves.empty());
  }
}

TEST_CASE("neither the order of the points nor the number of threads matters") {
  Random random(7);
  PointCloud cloud = room_points({4, 3, 2.5}, 0.025, kCurveNoise);
  add_round(cloud, {2, 1.5, 0}, {0, 0, 2.5}, 0.3, 2 * M_PI, 0.015, kCurveNoise, random);
  const Curves first = curves_of(cloud);
  REQUIRE(first.curves.size() == 1);
  for (int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    shuffle_points(cloud, static_cast<std::uint64_t>(threads));
    const Curves again = curves_of(cloud);
    CHECK(again.curves == first.curves);
    CHECK(again.of_site == first.of_site);
  }
}

TEST_CASE("what is round is out of the planes' reach") {
  Random random(8);
  PointCloud cloud = room_points({4, 3, 2.5}, 0.025, kCurveNoise);
  add_round(cloud, {2, 1.5, 0}, {0, 0, 2.5}, 0.3, 2 * M_PI, 0.015, kCurveNoise, random);
  Stages s = run_stages(std::move(cloud));
  Clustering clusters = s.grow();
  const Curves found = find_curves(s.grid, s.neighbors, s.scale, s.local, clusters);
  REQUIRE(found.curves.size() == 1);
  set_aside(found, s.grid, s.neighbors, s.local, clusters);
  check_clustering(s.grid, clusters);
  std::size_t round = 0;
  for (std::uint32_t i = 0; i < s.grid.sites.size(); ++i) {
    const bool is_round = found.of_site[i] != kNone;
    round += is_round;
    if (is_round) {
      CHECK(s.neighbors.of(i).empty());
      CHECK(clusters.label[i] == kNone);
    }
    for (std::uint32_t j : s.neighbors.of(i)) CHECK(found.of_site[j] == kNone);
  }
  CHECK(round > 100);
  CHECK(s.confirm().clusters.size() == 6);
}
