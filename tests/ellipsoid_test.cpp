// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/ellipsoid.h"

#include "support/support.h"
#include "world/solids.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// Points on an ellipsoid with these half axes, turned somehow; on its upper part alone where
// `lowest` is more than -1.
std::vector<Vec3> points_on(const Vec3& center, const Vec3& radii, Random& random,
                            double lowest = -1) {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vec3> points;
  while (points.size() < 800) {
    const Vec3 q = Vec3(random.gauss(), random.gauss(), random.gauss()).normalized();
    if (q.z() < lowest) continue;
    const Vec3 normal = q.cwiseQuotient(radii).normalized();
    points.push_back(center + turn * (q.cwiseProduct(radii) + kNoise * random.gauss() * normal));
  }
  return points;
}

}  // namespace

TEST_CASE("an ellipsoid is found again, to some millimetres, also where only 60 % of it was seen") {
  Random random(1);
  for (double lowest : {-1.0, -0.2}) {
    const Vec3 radii(0.15, 0.25, 0.4), center(3, -2, 1);
    const auto fitted = fit_ellipsoid(points_on(center, radii, random, lowest), kNoise);
    REQUIRE(fitted);
    CHECK((fitted->radii - radii).norm() < 0.02);
    CHECK((fitted->center - center).norm() < 0.015);
    for (const Vec3& p : points_on(center, radii, random))
      CHECK(std::abs(fitted->signed_distance(p)) < 0.04);
  }
}

TEST_CASE("the less of an ellipsoid is seen, the less sure it is") {
  Random random(2);
  double before = 0;
  for (double lowest : {-1.0, 0.0, 0.4, 0.6}) {
    const auto points = points_on({1, 1, 1}, {0.3, 0.3, 0.3}, random, lowest);
    const auto fitted = fit_ellipsoid(points, kNoise);
    REQUIRE(fitted);
    const double now = uncertainty_of(*fitted, points, kNoise);
    CHECK(now > before);
    before = now;
  }
  CHECK(before > 0.01);
}

TEST_CASE("points in a plane, in a line or in one place lie on no ellipsoid of their size") {
  for (const Vec3& size : {Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 0)}) {
    Random random(3);
    std::vector<Vec3> points;
    for (int i = 0; i < 200; ++i)
      points.push_back(Vec3(random.uniform(0, size.x()), random.uniform(0, size.y()), 0));
    if (const auto fitted = fit_ellipsoid(points, kNoise)) CHECK(fitted->radii.allFinite());
  }
  CHECK(!fit_ellipsoid(std::vector<Vec3>(5, Vec3::Zero()), kNoise));
}

TEST_CASE("a hull of 32 vertices follows an ellipsoid within 5 % of its axes") {
  Random random(4);
  const auto fitted = fit_ellipsoid(points_on({0, 0, 1}, {0.2, 0.3, 0.4}, random), kNoise);
  REQUIRE(fitted);
  const ConvexHull hull{corners_of(*fitted, 32)};
  CHECK(hull.vertices.size() == 32);
  const Mesh mesh = mesh_of(hull);
  CHECK(mesh.vertices.size() == 32);
  for (const auto& t : mesh.triangles) {
    Vec3 middle = Vec3::Zero();
    for (int v : t) middle += mesh.vertices[static_cast<std::size_t>(v)] / 3;
    CHECK(fitted->signed_distance(middle) < 0.0);
    CHECK(fitted->signed_distance(middle) > -0.02);
  }
  for (const Vec3& v : mesh.vertices) CHECK(fitted->signed_distance(v) < 0.05 * 0.4);
  CHECK(corners_of(*fitted, 12).size() == 12);
}
