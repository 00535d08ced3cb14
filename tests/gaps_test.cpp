// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/gaps.h"

#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

TEST_CASE("what a cupboard hides speaks hardly against a wall, a doorway does") {
  LabelledScan scan;
  // A wall in y = 0 with two gaps from the floor to 2 m; a cupboard's front before one of them.
  const int wall = scan.add({0, 0, 0}, {0, 0, 2.5}, {1, 0, 0});
  scan.add({2, 0, 0}, {0, 0, 2.5}, {1, 0, 0}, wall);
  scan.add({4, 0, 0}, {0, 0, 2.5}, {1, 0, 0}, wall);
  scan.add({1, 0, 2}, {0, 0, 0.5}, {3, 0, 0}, wall);
  scan.add({1, 0.5, 0}, {0, 0, 2}, {1, 0, 0});
  scan.cloud.viewpoints = {Vec3(2.5, 3, 1.5)};
  const Patch patch = scan.weighed_patches()[0];
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
  const Patch patch = scan.weighed_patches()[0];
  CHECK(evidence_at(patch, {1.25, 1.5, 0}) > -0.2);
  CHECK(evidence_at(patch, {2.5, 1.5, 0}) < -0.8);
}

TEST_CASE("a gap that is hidden for the most part is hidden also where nothing is just before it") {
  LabelledScan scan;
  scan.add({0, 0, 0}, {5, 0, 0}, {0, 3, 0});
  const int wall = scan.add({0, 0, 0}, {0, 0, 2.5}, {1, 0, 0});
  scan.add({3, 0, 0}, {0, 0, 2.5}, {2, 0, 0}, wall);
  scan.add({1, 0, 2}, {0, 0, 0.5}, {2, 0, 0}, wall);
  // As seen from the left, a box hides from x = 1 to 3 what is behind and beside it.
  scan.add({1, 0.5, 0}, {0, 0, 2}, {1.5, 0, 0});
  scan.cloud.viewpoints = {Vec3(0.5, 2, 1.5)};
  const Patch patch = scan.weighed_patches()[1];
  REQUIRE(patch.plane.normal.y() > 0.99);
  CHECK(evidence_at(patch, {1.5, 0, 1}) > 0);
  CHECK(evidence_at(patch, {2.8, 0, 1}) > 0);
  CHECK(evidence_at(patch, {2.8, 0, -0.1}) < 0);
}

TEST_CASE("a floor goes on below clutter up to the wall") {
  LabelledScan scan;
  const int floor = scan.add({0, 1, 0}, {4, 0, 0}, {0, 2, 0});
  scan.add({0, 0, 0}, {1.5, 0, 0}, {0, 1, 0}, floor);
  scan.add({2.5, 0, 0}, {1.5, 0, 0}, {0, 1, 0}, floor);
  scan.add({0, 0, 0}, {0, 0, 2.5}, {4, 0, 0});
  scan.cloud.viewpoints = {Vec3(2, 2, 1.5)};
  const Patch patch = scan.weighed_patches()[0];
  CHECK(evidence_at(patch, {2, 0.2, 0}) > -0.2);
  CHECK(evidence_at(patch, {2, -0.15, 0}) < -0.8);
}

TEST_CASE("what is hidden before one face of a wall is open where the other face has a doorway") {
  LabelledScan scan;
  const auto add_face = [&](double y, bool has_second_gap) {
    const int face = scan.add({0, y, 0}, {0, 0, 2.5}, {1, 0, 0});
    scan.add({2, y, 0}, {0, 0, 2.5}, {1, 0, 0}, face);
    if (!has_second_gap) scan.add({3, y, 0}, {0, 0, 2}, {1, 0, 0}, face);
    scan.add({4, y, 0}, {0, 0, 2.5}, {1, 0, 0}, face);
    scan.add({1, y, 2}, {0, 0, 0.5}, {3, 0, 0}, face);
  };
  // Both faces have a gap from x = 1 to 2, one of them another one from 3 to 4; cupboards hide
  // both.
  add_face(0, true);
  add_face(-0.1, false);
  scan.add({0, -2, 0}, {5, 0, 0}, {0, 4, 0});
  scan.add({1, 0.5, 0}, {0, 0, 2}, {1, 0, 0});
  scan.add({3, 0.5, 0}, {0, 0, 2}, {1, 0, 0});
  scan.cloud.viewpoints = {Vec3(2.5, 3, 1.5), Vec3(2.5, -3, 1.5)};
  const Patch face = scan.weighed_patches()[0];
  REQUIRE(face.plane.normal.y() > 0.99);
  CHECK(evidence_at(face, {1.5, 0, 1}) < -0.5);
  CHECK(evidence_at(face, {3.5, 0, 1}) > 0);
}
