// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/free_edges.h"

#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

namespace {

std::vector<FreeEdge> edges_of(const LabelledScan& scan) {
  const std::vector<Patch> patches = scan.patches();
  return find_free_edges(scan.cloud, scan.members(), patches,
                         lines_of(patches, find_seams(patches)));
}

}  // namespace

TEST_CASE("a plate that meets nothing has four edges, a centimetre off at most") {
  for (double turn : {0.0, 0.3, 0.7}) {
    const Vec3 a(std::cos(turn), std::sin(turn), 0), b(-a.y(), a.x(), 0);
    LabelledScan scan;
    scan.add({1, 1, 0.7}, 1.6 * a, 0.9 * b);
    const Vec3 middle = Vec3(1, 1, 0.7) + 0.8 * a + 0.45 * b;
    std::vector<double> found;
    double length = 0;
    for (const FreeEdge& e : edges_of(scan)) {
      length += (e.to - e.from).norm();
      CHECK(std::abs(e.plane.normal.z()) < 0.02);
      CHECK(e.plane.signed_distance(middle) < 0);  // its normal points away from the plate
      const double along_a = std::abs(e.plane.normal.dot(a)),
                   along_b = std::abs(e.plane.normal.dot(b));
      if (std::max(along_a, along_b) < 0.98) continue;  // across a corner
      const Vec3 off = (e.from + e.to) / 2 - middle;
      const double beyond =
          along_a > along_b ? std::abs(off.dot(a)) - 0.8 : std::abs(off.dot(b)) - 0.45;
      CHECK(std::abs(beyond) < 0.012);
      found.push_back(beyond);
    }
    CHECK(found.size() >= 4);
    CHECK(length > 4);
  }
}

TEST_CASE("there are no free edges along seams, and those of a doorway are where it is") {
  LabelledScan scan;
  scan.add({0, 0, 0}, {4, 0, 0}, {0, 2, 0});
  const int wall = scan.add({0, 0, 0}, {0, 0, 2.5}, {1.5, 0, 0});
  scan.add({2.4, 0, 0}, {0, 0, 2.5}, {1.6, 0, 0}, wall);
  scan.add({1.5, 0, 2}, {0, 0, 0.5}, {0.9, 0, 0}, wall);
  int jambs = 0, lintels = 0;
  for (const FreeEdge& e : edges_of(scan)) {
    if (e.patch != wall) continue;
    const Vec3 m = (e.from + e.to) / 2;
    CHECK(m.z() > 0.05);
    if (std::abs(e.plane.normal.x()) > 0.99 && m.x() > 1 && m.x() < 3) {
      ++jambs;
      CHECK(std::min(std::abs(m.x() - 1.5), std::abs(m.x() - 2.4)) < 0.012);
    }
    if (std::abs(e.plane.normal.z()) > 0.99 && m.z() < 2.3) {
      ++lintels;
      CHECK(std::abs(m.z() - 2) < 0.012);
    }
  }
  CHECK(jambs >= 2);
  CHECK(lintels >= 1);
}

TEST_CASE("the corner of a doorway that looks cut off is none of its edges, that of a gable is") {
  for (const bool is_gable : {false, true}) {
    LabelledScan scan;
    scan.add({0, 0, 0}, {4, 0, 0}, {0, 2, 0});
    const int wall = scan.add({0, 0, 0}, {0, 0, 2.5}, {1.5, 0, 0});
    scan.add({2.4, 0, 0}, {0, 0, 2.5}, {1.6, 0, 0}, wall);
    scan.add({1.5, 0, 2}, {0, 0, 0.5}, {0.9, 0, 0}, wall);
    // More of the wall below the lintel, in steps from one corner: down the whole height, or a bit.
    const double step = is_gable ? 0.1 : 0.02;
    for (int k = 0; k < 12; ++k)
      scan.add({1.5, 0, 2 - (k + 1) * step}, {0, 0, step},
               {(is_gable ? 0.8 : 0.3) * (1 - k / 12.0), 0, 0}, wall);
    int slanted = 0;
    double top = 0;
    for (const FreeEdge& e : edges_of(scan)) {
      const Vec3 m = (e.from + e.to) / 2;
      if (e.patch != wall || m.x() < 1.3 || m.x() > 2.6 || m.z() > 2.3) continue;
      slanted += std::abs(e.plane.normal.x()) < 0.97 && std::abs(e.plane.normal.z()) < 0.97;
      top = std::max({top, e.from.z(), e.to.z()});
    }
    CHECK((slanted > 0) == is_gable);
    CHECK(top < 2.05);
  }
}
