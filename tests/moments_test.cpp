// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/moments.h"

#include <cstring>

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

Moments sum_of(const std::vector<Vec3>& points) {
  Moments m;
  for (const Vec3& p : points) m += p;
  return m;
}

// Whole numbers, whose sums and products are exact.
std::vector<Vec3> whole_points(Random& random, int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(random.whole(-99, 99), random.whole(-99, 99), random.whole(-99, 99));
  return points;
}

bool same(const Moments& a, const Moments& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

TEST_CASE("moments are the points' number, mean and covariance") {
  Random random(1);
  for (int round = 0; round < 50; ++round) {
    const std::vector<Vec3> points = whole_points(random, random.whole(1, 100));
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
    Mat3 covariance = Mat3::Zero();
    for (const Vec3& p : points)
      covariance += (p - mean) * (p - mean).transpose() / static_cast<double>(points.size());
    const Moments m = sum_of(points);
    CHECK(m.n == static_cast<double>(points.size()));
    CHECK((m.mean() - mean).norm() < 1e-9);
    CHECK((m.covariance() - covariance).norm() < 1e-8);
  }
}

TEST_CASE("moments add up, and what was added can be taken away again") {
  Random random(2);
  const std::vector<Vec3> a = whole_points(random, 70), b = whole_points(random, 30);
  std::vector<Vec3> both = a;
  both.insert(both.end(), b.begin(), b.end());
  CHECK(same(sum_of(a) + sum_of(b), sum_of(both)));
  Moments left = sum_of(both);
  left -= sum_of(a);
  CHECK(same(left, sum_of(b)));
  left -= sum_of(b);
  CHECK(same(left, Moments()));
}

TEST_CASE("the mean square about a plane is that of the points' distances") {
  Random random(3);
  const std::vector<Vec3> points = whole_points(random, 200);
  const Moments m = sum_of(points);
  for (int round = 0; round < 50; ++round) {
    const Plane plane{random.direction(), random.uniform(-200, 200)};
    double sum = 0;
    for (const Vec3& p : points) sum += std::pow(plane.signed_distance(p), 2);
    CHECK(m.mean_square(plane) ==
          doctest::Approx(sum / static_cast<double>(points.size())).scale(0).epsilon(1e-9));
  }
}

TEST_CASE("points of a plane give this plane back, with their centroid and spread") {
  Random random(4);
  for (int round = 0; round < 100; ++round) {
    const Vec3 normal = random.direction(), at = 50 * random.direction();
    const PlaneFrame frame = frame_of(plane_through(at, normal), at);
    Moments m;
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < 500; ++i) {
      const Vec3 p =
          frame.to_space({random.gauss() * 2, random.gauss()}) + 0.01 * random.gauss() * normal;
      m += p, sum += p;
    }
    const MomentFit f = fit(m);
    CHECK((f.centroid - sum / 500).norm() < 1e-9);
    CHECK(std::abs(f.plane.signed_distance(f.centroid)) < 1e-9);
    CHECK(f.plane.normal.cross(normal).norm() < 0.002);
    CHECK(std::abs(f.axis.dot(frame.u)) > 0.95);
    CHECK(std::sqrt(f.variance[0]) == doctest::Approx(0.01).scale(0).epsilon(0.15));
    CHECK(std::sqrt(f.variance[1]) == doctest::Approx(1).scale(0).epsilon(0.15));
    CHECK(std::sqrt(f.variance[2]) == doctest::Approx(2).scale(0).epsilon(0.15));
    CHECK(m.mean_square(f.plane) == doctest::Approx(f.variance[0]).scale(0).epsilon(1e-4));
  }
}

TEST_CASE("no other plane is nearer to the points than the one fitted") {
  Random random(5);
  const Moments m = sum_of(whole_points(random, 40));
  const MomentFit f = fit(m);
  const double least = m.mean_square(f.plane);
  for (int round = 0; round < 200; ++round) {
    const Vec3 normal = (f.plane.normal + random.uniform(0, 0.5) * random.direction()).normalized();
    const Plane other = plane_through(f.centroid + random.gauss() * normal, normal);
    CHECK(m.mean_square(other) >= least);
  }
}

TEST_CASE("exactly flat, straight or equal points have a plane through them all") {
  Moments flat, line, one;
  for (int i = 0; i < 100; ++i) {
    flat += Vec3(i % 10, i / 10, 7);
    line += Vec3(i, 2 * i, -i);
    one += Vec3(3, 4, 5);
  }
  CHECK(fit(flat).variance[0] == 0);
  CHECK(std::abs(fit(flat).plane.normal.z()) == 1);
  for (const Moments& m : {flat, line, one}) {
    const MomentFit f = fit(m);
    CHECK(f.plane.normal.norm() == doctest::Approx(1));
    CHECK(m.mean_square(f.plane) < 1e-9);
    CHECK(f.variance[0] >= 0);
    CHECK(f.variance[0] < 1e-9);
  }
}
