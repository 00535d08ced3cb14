// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/facing.h"

#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

TEST_CASE("the normal points to the viewpoint, or to where normals point") {
  for (double side : {1.0, -1.0}) {
    LabelledScan scan;
    scan.add({0, 0, 0}, {2, 0, 0}, {0, 2, 0});
    scan.cloud.normals.assign(scan.cloud.points.size(), Vec3f(0, 0, static_cast<float>(-side)));
    CHECK(scan.patches()[0].plane.normal.z() == doctest::Approx(-side));
    scan.cloud.viewpoints = {Vec3(1, 1, 0.5 * side)};
    CHECK(scan.patches()[0].plane.normal.z() == doctest::Approx(side));
  }
}

TEST_CASE("the viewpoint that counts is one with a free line, not the nearest one behind a wall") {
  LabelledScan scan;
  for (double y : {3.0, 3.15}) scan.add({0, y, 0}, {4, 0, 0}, {0, 0, 2.5});
  scan.cloud.viewpoints = {Vec3(2, 2.8, 1), Vec3(2, 5, 1)};
  const std::vector<Patch> patches = scan.patches();
  CHECK(patches[0].plane.normal.y() == doctest::Approx(-1));
  CHECK(patches[1].plane.normal.y() == doctest::Approx(1));
}

TEST_CASE("without viewpoints the faces of rooms, walls, boards and boxes look out of them") {
  LabelledScan scan;
  struct Face {
    int plane;
    Vec3 outward;
  };
  std::vector<Face> faces;
  // A box's faces, looking into it or out of it.
  const auto add_box = [&](const Vec3& low, const Vec3& size, double sign) {
    for (int a = 0; a < 3; ++a)
      for (double end : {0.0, 1.0}) {
        const Vec3 u = size[(a + 1) % 3] * Vec3::Unit((a + 1) % 3),
                   v = size[(a + 2) % 3] * Vec3::Unit((a + 2) % 3);
        const Vec3 outward = sign * (2 * end - 1) * Vec3::Unit(a);
        faces.push_back({scan.add(low + end * size[a] * Vec3::Unit(a), u, v), outward});
      }
  };
  add_box({0, 0, 0}, {5, 3, 2.5}, -1);          // a room
  add_box({0, 3.12, 0}, {5, 9, 2.5}, -1);       // a larger one behind a thin wall
  add_box({1, 1, 0.5}, {0.8, 0.4, 1.2}, 1);     // a box
  add_box({2.5, 1, 0.7}, {1.2, 0.8, 0.03}, 1);  // a table's board
  const std::vector<Patch> patches = scan.patches();
  for (const Face& face : faces) {
    CAPTURE(face.plane);
    CHECK(patches[static_cast<std::size_t>(face.plane)].plane.normal.dot(face.outward) > 0.9);
  }
}

TEST_CASE("a patch and its flipped twin say the same of every place") {
  LabelledScan scan;
  scan.add({0.3, 0, 0}, {2, 0.4, 0}, {0, 1.5, 0.3});
  const Patch patch = scan.patches()[0], other = flipped(patch);
  CHECK(other.plane.normal == -patch.plane.normal);
  for (double a : {-0.1, 0.2, 1.1, 1.9})
    for (double b : {-0.1, 0.7, 1.4}) {
      const Vec3 p = Vec3(0.3, 0, 0) + a * Vec3(1, 0.2, 0) + b * Vec3(0, 0.981, 0.196);
      CHECK(other.hit.is_set(other.frame.to_plane(p)) == patch.hit.is_set(patch.frame.to_plane(p)));
      CHECK(evidence_at(other, p) == evidence_at(patch, p));
    }
  CHECK(flipped(other).evidence == patch.evidence);
}
