// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/patch.h"

#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

namespace {

float evidence_at(const Patch& patch, const Vec3& p) {
  const Vec2 q = (patch.frame.to_plane(p) - patch.hit.low) / patch.hit.cell;
  return patch.evidence[patch.hit.index(static_cast<int>(q.x()), static_cast<int>(q.y()))];
}

}  // namespace

TEST_CASE("points are grouped by their planes, those of none left out") {
  const std::vector<std::int32_t> labels = {2, -1, 0, 2, 0, -1, 2};
  const Members members = group_points(labels, 4);
  const auto of = [&](std::size_t plane) {
    return std::vector<std::uint32_t>(members.of(plane).begin(), members.of(plane).end());
  };
  CHECK(of(0) == std::vector<std::uint32_t>{2, 4});
  CHECK(of(1).empty());
  CHECK(of(2) == std::vector<std::uint32_t>{0, 3, 6});
  CHECK(of(3).empty());
}

TEST_CASE("cells have evidence for the surface where points are, against it where they end") {
  LabelledScan scan;
  scan.add({0, 0, 0}, {2, 0, 0}, {0, 1, 0});
  const Patch patch = scan.patches()[0];
  CHECK(evidence_at(patch, {1, 0.5, 0}) >= 1);
  CHECK(evidence_at(patch, {2.15, 0.5, 0}) < -0.5);
  CHECK(patch.covered.is_set(patch.frame.to_plane({1, 0.5, 0})));
  CHECK_FALSE(patch.covered.is_set(patch.frame.to_plane({2.15, 0.5, 0})));
}

TEST_CASE("what is sparse is no less there: its gaps say little") {
  LabelledScan scan;
  scan.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    scan.cloud.points.emplace_back(static_cast<float>(random.uniform(1, 3)),
                                   static_cast<float>(random.uniform(0, 1)), 0.f);
    scan.labels.push_back(0);
  }
  const Patch patch = scan.patches()[0];
  double dense = 0, sparse = 0;
  for (std::size_t i = 0; i < patch.evidence.size(); ++i) {
    const Vec3 p = patch.frame.to_space(patch.middle[i]);
    if (p.y() < 0 || p.y() > 1 || p.x() < 0 || p.x() > 3) continue;
    (p.x() < 1 ? dense : sparse) += static_cast<double>(patch.evidence[i]);
  }
  CHECK(dense > 0);
  CHECK(sparse > 0);
}

TEST_CASE("the normal points to the viewpoint, to where normals point, or to where the place is") {
  for (double side : {1.0, -1.0}) {
    LabelledScan scan;
    scan.add({0, 0, 0}, {2, 0, 0}, {0, 2, 0});
    scan.add({0, 0, side}, {2, 0, 0}, {0, 2, 0});
    CHECK(scan.patches()[0].plane.normal.z() == doctest::Approx(side));
    scan.cloud.normals.assign(scan.cloud.points.size(), Vec3f(0, 0, static_cast<float>(-side)));
    CHECK(scan.patches()[0].plane.normal.z() == doctest::Approx(-side));
    scan.cloud.viewpoints = {Vec3(1, 1, 0.5 * side)};
    CHECK(scan.patches()[0].plane.normal.z() == doctest::Approx(side));
  }
}

TEST_CASE("what a cupboard hides speaks hardly against a wall, a doorway does") {
  LabelledScan scan;
  // A wall in y = 0 with two gaps from the floor to 2 m; a cupboard's front before one of them.
  const int wall = scan.add({0, 0, 0}, {0, 0, 2.5}, {1, 0, 0});
  scan.add({2, 0, 0}, {0, 0, 2.5}, {1, 0, 0}, wall);
  scan.add({4, 0, 0}, {0, 0, 2.5}, {1, 0, 0}, wall);
  scan.add({1, 0, 2}, {0, 0, 0.5}, {3, 0, 0}, wall);
  scan.add({1, 0.5, 0}, {0, 0, 2}, {1, 0, 0});
  scan.cloud.viewpoints = {Vec3(2.5, 3, 1.5)};
  const Patch patch = scan.patches()[0];
  REQUIRE(patch.plane.normal.y() > 0.99);
  CHECK(evidence_at(patch, {1.5, 0, 1}) > -0.2);
  CHECK(evidence_at(patch, {3.5, 0, 1}) < -0.8);
}

TEST_CASE("a floor has no hole where a scanner stood, but one over what is below") {
  LabelledScan scan;
  const int floor = scan.add({0, 0, 0}, {4, 0, 0}, {0, 1, 0});
  scan.add({0, 2, 0}, {4, 0, 0}, {0, 1, 0}, floor);
  for (double x : {0.0, 1.5, 3.0})
    scan.add({x, 1, 0}, {x == 1.5 ? 0.5 : 1.0, 0, 0}, {0, 1, 0}, floor);
  scan.add({2, 1, -1}, {1, 0, 0}, {0, 1, 0});
  scan.cloud.viewpoints = {Vec3(2, 1.5, 1.5)};
  const Patch patch = scan.patches()[0];
  CHECK(evidence_at(patch, {1.25, 1.5, 0}) > -0.2);
  CHECK(evidence_at(patch, {2.5, 1.5, 0}) < -0.8);
}
