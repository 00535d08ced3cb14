// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/find_up.h"

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// A turn by an angle about a level axis.
Eigen::Quaterniond tilt(double angle, double azimuth) {
  return Eigen::Quaterniond(
      Eigen::AngleAxisd(angle, Vec3(std::cos(azimuth), std::sin(azimuth), 0)));
}

// A place with floor, ceiling and walls to all sides, normals to either side.
std::vector<Facing> place(Random& random) {
  std::vector<Facing> facings = {{Vec3::UnitZ(), 20}, {-Vec3::UnitZ(), 18}};
  const double heading = random.uniform(0, M_PI);
  for (int k = 0; k < 8; ++k) {
    const double azimuth = heading + k * M_PI / 4;
    facings.push_back({{std::cos(azimuth), std::sin(azimuth), 0}, random.uniform(2, 12)});
  }
  return facings;
}

void turn(std::vector<Facing>& facings, const Eigen::Quaterniond& by) {
  for (Facing& f : facings) f.normal = by * f.normal;
}

}  // namespace

TEST_CASE("up is found exactly where floors, ceilings and walls are exact, however tilted") {
  Random random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<Facing> facings = place(random);
    const Eigen::Quaterniond by = tilt(random.uniform(0.002, 0.42), random.uniform(0, 2 * M_PI));
    turn(facings, by);
    shuffle(facings, random);
    const Up up = find_up(facings, Vec3::UnitZ());
    CHECK(up.is_found);
    CHECK_FALSE(up.is_partial);
    CHECK(up.share == doctest::Approx(1));
    CHECK(angle_between(up.direction, by * Vec3::UnitZ()) < 0.002 * kDegree);
    CHECK(up.angle == doctest::Approx(angle_between(up.direction, Vec3::UnitZ())));
  }
}

TEST_CASE("walls alone tell up, and floors alone") {
  Random random(2);
  const Eigen::Quaterniond by = tilt(0.1, 1);
  std::vector<Facing> facings = place(random);
  turn(facings, by);
  const std::vector<Facing> floors(facings.begin(), facings.begin() + 2),
      walls(facings.begin() + 2, facings.end());
  for (const auto& part : {floors, walls}) {
    const Up up = find_up(part, Vec3::UnitZ());
    CHECK(up.is_found);
    CHECK_FALSE(up.is_partial);
    CHECK(angle_between(up.direction, by * Vec3::UnitZ()) < 0.01 * kDegree);
  }
}

TEST_CASE("slopes, a bowed ceiling and furniture askew hardly turn up") {
  Random random(3);
  for (int round = 0; round < 100; ++round) {
    std::vector<Facing> facings = place(random);
    for (Facing& f : facings)  // of the noise
      f.normal = (f.normal + 0.0003 * random.direction()).normalized();
    facings[1].normal = tilt(0.02, random.uniform(0, 6)) * facings[1].normal;
    facings.push_back({tilt(0.15, random.uniform(0, 6)) * Vec3::UnitZ(), 15});
    for (int k = 0; k < 30; ++k) facings.push_back({random.direction(), 0.3});
    const Eigen::Quaterniond by = tilt(random.uniform(0.01, 0.2), random.uniform(0, 2 * M_PI));
    turn(facings, by);
    const Up up = find_up(facings, Vec3::UnitZ());
    CHECK(up.is_found);
    CHECK(angle_between(up.direction, by * Vec3::UnitZ()) < 0.05 * kDegree);
  }
}

TEST_CASE("parallel walls tell one direction of up, and the axis the other") {
  std::vector<Facing> facings = {{Vec3::UnitX(), 10}, {-Vec3::UnitX(), 8}};
  turn(facings, tilt(0.1, M_PI / 2));  // about y
  const Up up = find_up(facings, Vec3::UnitZ());
  CHECK(up.is_partial);
  CHECK(angle_between(up.direction, tilt(0.1, M_PI / 2) * Vec3::UnitZ()) < 0.01 * kDegree);
}

TEST_CASE("up is the axis where nothing is there, where all is near it, or where nothing agrees") {
  Random random(4);
  CHECK(find_up({}, Vec3::UnitZ()).direction == Vec3::UnitZ());
  CHECK(find_up({{Vec3::UnitX(), 0}}, -Vec3::UnitY()).direction == -Vec3::UnitY());
  CHECK_FALSE(find_up({}, Vec3::UnitZ()).is_found);
  std::vector<Facing> facings = place(random);
  turn(facings, tilt(0.04 * kDegree, 1));
  const Up near = find_up(facings, Vec3::UnitZ());
  CHECK(near.direction == Vec3::UnitZ());
  CHECK(near.angle == doctest::Approx(0.04 * kDegree).epsilon(0.01));
  std::vector<Facing> rocks;
  for (int k = 0; k < 200; ++k) rocks.push_back({random.direction(), random.uniform()});
  CHECK_FALSE(find_up(rocks, Vec3::UnitZ()).is_found);
}

TEST_CASE("of a scanner that was not levelled up is square to the floor, however warped the rest is") {
  const auto warped = [](double by) {
    std::vector<Facing> facings = {{Vec3::UnitZ(), 8, {0, 0, -1}},
                                   {tilt(0.05, 1) * -Vec3::UnitZ(), 10, {0, 0, 2}},
                                   {tilt(0.05, M_PI / 2) * Vec3::UnitX(), 9, {3, 0, 0}},
                                   {tilt(0.05, 0) * Vec3::UnitY(), 9, {0, 3, 0}}};
    turn(facings, tilt(by, 2));
    for (Facing& f : facings) f.middle = tilt(by, 2) * f.middle;
    return find_up(facings, Vec3::UnitZ());
  };
  const Up tilted = warped(0.2);
  CHECK(angle_between(tilted.direction, tilt(0.2, 2) * Vec3::UnitZ()) < 1e-9);
  CHECK(tilted.angle == doctest::Approx(0.2));
  // A floor that slopes in a scan that is level but for it.
  const Up level = find_up({{tilt(0.05, 1) * Vec3::UnitZ(), 8, {0, 0, -1}},
                            {-Vec3::UnitZ(), 10, {0, 0, 2}},
                            {Vec3::UnitX(), 9, {3, 0, 0}},
                            {Vec3::UnitY(), 9, {0, 3, 0}}},
                           Vec3::UnitZ());
  CHECK(level.direction == Vec3::UnitZ());
}

TEST_CASE("a warped scan has the up that most of it is near to") {
  std::vector<Facing> facings = {{Vec3::UnitZ(), 10},
                                 {tilt(0.12, 0) * -Vec3::UnitZ(), 8},
                                 {tilt(0.06, M_PI / 2) * Vec3::UnitX(), 6},
                                 {tilt(0.06, 0) * Vec3::UnitY(), 6}};
  turn(facings, tilt(0.2, 2));
  const Up up = find_up(facings, Vec3::UnitZ());
  CHECK(up.is_found);
  CHECK(up.tolerance > UpOptions{}.tolerance);
  CHECK(angle_between(up.direction, tilt(0.2, 2) * Vec3::UnitZ()) < 6 * kDegree);
}
