// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/find_frame.h"

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// Floor and two walls of a place that is turned.
std::vector<Facing> corner(const Eigen::Quaterniond& by) {
  return {{by * Vec3::UnitZ(), 10}, {by * Vec3::UnitX(), 6}, {by * Vec3::UnitY(), 6}};
}

}  // namespace

TEST_CASE("a level scan has its own z axis as up, to the bit") {
  PointCloud cloud;
  cloud.origin = {1, 2, 3};
  const Frame frame = find_frame(cloud, corner(Eigen::Quaterniond::Identity()));
  CHECK(frame.origin == Vec3(1, 2, 3));
  CHECK(frame.up == Vec3::UnitZ());
  CHECK(contains(frame.assumed.back(), "up is +z"));
  CHECK(contains(frame.assumed.back(), "100 %"));
}

TEST_CASE("a tilted scan has the up of its surfaces, and the frame says by how much") {
  const Eigen::Quaterniond by(Eigen::AngleAxisd(0.05, Vec3::UnitY()));
  const Frame frame = find_frame({}, corner(by));
  CHECK((frame.up - by * Vec3::UnitZ()).norm() < 5e-5);
  CHECK(frame.rotation.coeffs() == Eigen::Quaterniond::Identity().coeffs());
  CHECK(contains(frame.assumed.back(), "2.86 degrees off +z"));
}

TEST_CASE("where surfaces do not agree up is the axis, and the frame says so") {
  Random random(1);
  std::vector<Facing> rocks;
  for (int k = 0; k < 100; ++k) rocks.push_back({random.direction(), 1});
  const Frame frame = find_frame({}, rocks);
  CHECK(frame.up == Vec3::UnitZ());
  CHECK(contains(frame.assumed.back(), "too few surfaces agree"));
  CHECK(contains(find_frame({}, {}).assumed.back(), "does not say otherwise"));
}

TEST_CASE("a pitched camera's up is against its y axis, and its floor tells") {
  PointCloud cloud;
  cloud.camera_frame = true;
  for (double pitch : {-0.6, -0.3, 0.0, 0.3, 0.6}) {
    const Eigen::Quaterniond by(Eigen::AngleAxisd(M_PI / 2 + pitch, Vec3::UnitX()));
    const Frame frame = find_frame(cloud, {{by * Vec3::UnitZ(), 3}, {by * Vec3::UnitX(), 1}});
    CHECK((frame.up - by * Vec3::UnitZ()).norm() < 5e-5);
    CHECK(contains(frame.assumed.back(), "camera"));
  }
  CHECK(find_frame(cloud, {}).up == -Vec3::UnitY());
}

TEST_CASE("surfaces speak for up by the area that was seen of them") {
  const FoundSurface wall{.plane = {Vec3::UnitY(), 0},
                          .outer = {{0, 0, 0}, {0, 0, 2}, {5, 0, 2}, {5, 0, 0}},
                          .holes = {{{1, 0, 0.5}, {2, 0, 0.5}, {2, 0, 1.5}, {1, 0, 1.5}}},
                          .support = {100, 0.01, 0.5},
                          .color = {}};
  const std::vector<Facing> facings = facings_of({wall});
  REQUIRE(facings.size() == 1);
  CHECK(facings[0].normal == Vec3::UnitY());
  CHECK(facings[0].weight == doctest::Approx((10 - 1) * 0.5));
}
