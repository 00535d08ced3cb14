// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "thesis/plane_fit.h"

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;
using thesis::fit_plane;

TEST_CASE("the plane of points that lie in one is found, however it is turned") {
  Random random(1);
  for (int round = 0; round < 200; ++round) {
    const Plane plane = plane_through(10 * random.direction(), random.direction());
    const PlaneFrame frame = frame_of(plane);
    std::vector<Vec3> points;
    for (int i = 0; i < random.whole(3, 40); ++i)
      points.push_back(frame.to_space(Vec2(random.gauss(), random.gauss())));
    const auto fit = fit_plane(points);
    REQUIRE(fit);
    CHECK(std::abs(fit->plane.normal.dot(plane.normal)) ==
          doctest::Approx(1).scale(0).epsilon(1e-6));
    for (const Vec3& p : points) CHECK(std::abs(fit->plane.signed_distance(p)) < 1e-6);
    int largest = 0;
    fit->plane.normal.cwiseAbs().maxCoeff(&largest);
    CHECK(fit->plane.normal[largest] > 0);  // the sign is fixed
  }
}

TEST_CASE("no plane has a smaller sum of squared distances than the fitted one") {
  Random random(2);
  for (int round = 0; round < 50; ++round) {
    std::vector<Vec3> points;
    for (int i = 0; i < 30; ++i)
      points.emplace_back(3 * random.gauss(), random.gauss(), 0.3 * random.gauss());
    const auto error = [&](const Plane& plane) {
      double sum = 0;
      for (const Vec3& p : points) sum += std::pow(plane.signed_distance(p), 2);
      return sum;
    };
    const auto fit = fit_plane(points);
    REQUIRE(fit);
    for (int other = 0; other < 20; ++other) {
      const Vec3 normal = (fit->plane.normal + 0.05 * random.direction()).normalized();
      CHECK(error(fit->plane) <=
            error(plane_through(fit->centroid + 0.05 * random.direction(), normal)) + 1e-12);
    }
  }
}

TEST_CASE("points that tell no plane give none") {
  CHECK_FALSE(fit_plane({}));
  CHECK_FALSE(fit_plane({{0, 0, 0}, {1, 0, 0}}));
  CHECK_FALSE(fit_plane(std::vector<Vec3>(100, Vec3(1, 2, 3))));
  std::vector<Vec3> line;
  for (int i = 0; i < 100; ++i) line.push_back(Vec3(1, 2, 3) + 0.1 * i * Vec3(3, -1, 2));
  CHECK_FALSE(fit_plane(line));
}
