// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "thesis/hull.h"

#include <algorithm>

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::thesis;

namespace {

struct Case {
  PlaneFrame frame;
  Vec3 normal;
  std::vector<Vec3> points;
};

// Points in a plane turned at random: on a grid (many on one line, many the same), on a circle, or
// anywhere.
Case random_case(Random& random) {
  const Plane plane = plane_through(5 * random.direction(), random.direction());
  Case c{.frame = frame_of(plane, 3 * random.direction()), .normal = plane.normal, .points = {}};
  const int kind = random.whole(0, 2), count = random.whole(1, 60);
  for (int i = 0; i < count; ++i) {
    const double angle = random.uniform(0, 2 * M_PI);
    const Vec2 p = kind == 0   ? Vec2(random.whole(0, 5), random.whole(0, 5))
                   : kind == 1 ? Vec2(std::cos(angle), std::sin(angle))
                               : Vec2(random.gauss(), random.gauss());
    c.points.push_back(c.frame.to_space(p));
  }
  return c;
}

}  // namespace

TEST_CASE("the hull is convex, counter-clockwise, made of given points, and holds all of them") {
  Random random(1);
  for (int round = 0; round < 2000; ++round) {
    const Case c = random_case(random);
    const std::vector<Vec3> hull = convex_hull(c.points, c.normal);
    for (const Vec3& v : hull)
      CHECK(std::find(c.points.begin(), c.points.end(), v) != c.points.end());
    if (hull.size() < 3) continue;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec3 &a = hull[i], &b = hull[(i + 1) % hull.size()],
                 &next = hull[(i + 2) % hull.size()];
      CHECK((b - a).cross(next - b).dot(c.normal) > 0);
      for (const Vec3& p : c.points)
        CHECK((b - a).cross(p - a).dot(c.normal) / (b - a).norm() > -1e-8);
    }
  }
}

TEST_CASE("points on a line have no hull with an area") {
  std::vector<Vec3> line;
  for (int i = 0; i < 20; ++i)
    line.push_back(Vec3(1, 2, 3) + ((i * 7) % 20) * Vec3(0.1, 0.2, -0.1));
  CHECK(convex_hull(line, Vec3(2, -1, 0).normalized()).size() < 3);
  CHECK(convex_hull({}, Vec3::UnitZ()).empty());
  CHECK(convex_hull(std::vector<Vec3>(5, Vec3(1, 1, 1)), Vec3::UnitZ()).size() == 1);
}

TEST_CASE("a line first, then a point beside it, in any direction along it") {
  for (const std::vector<double>& xs :
       {std::vector<double>{0, 1, 2, 3}, {3, 1, 0, 2}, {1, 2, 0, 3}, {0, 0, 3, 3}}) {
    std::vector<Vec3> points;
    for (double x : xs) points.emplace_back(x, 0, 0);
    points.emplace_back(1, 1, 0);
    CHECK(convex_hull(points, Vec3::UnitZ()).size() == 3);
    points.back() = Vec3(1, -1, 0);
    CHECK(convex_hull(points, Vec3::UnitZ()).size() == 3);
  }
}
