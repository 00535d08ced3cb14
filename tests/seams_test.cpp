// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/seams.h"

#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

TEST_CASE("the line of two planes lies in both, at the parameter that it says") {
  Random random(5);
  const auto any = [&] {
    return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  };
  for (int k = 0; k < 50; ++k) {
    const Plane a = plane_through(5 * any(), any().normalized()),
                b = plane_through(5 * any(), any().normalized());
    const auto line = intersect(a, b, 0.17);
    CHECK(line.has_value() == (a.normal.cross(b.normal).norm() >= 0.17));
    if (!line) continue;
    for (double t : {-3.0, 0.0, 7.5}) {
      CHECK(a.signed_distance(line->at(t)) == doctest::Approx(0).epsilon(1e-9));
      CHECK(b.signed_distance(line->at(t)) == doctest::Approx(0).epsilon(1e-9));
      CHECK(line->direction.dot(line->at(t)) == doctest::Approx(t));
    }
  }
}

TEST_CASE("a wall and a floor have a seam where both are, and know it for sure") {
  LabelledScan scan;
  scan.add({0, 0, 0}, {3, 0, 0}, {0, 2, 0});
  scan.add({1, 0, 0}, {0, 0, 2}, {4, 0, 0});
  const std::vector<Seam> seams = find_seams(scan.patches());
  REQUIRE(seams.size() == 1);
  CHECK(seams[0].a == 0);
  CHECK(seams[0].b == 1);
  for (const auto& list : {seams[0].seen, seams[0].sure}) {
    REQUIRE(list.size() == 1);
    const double x0 = seams[0].line.at(list[0].low).x(), x1 = seams[0].line.at(list[0].high).x();
    CHECK(std::min(x0, x1) == doctest::Approx(1).scale(0).epsilon(0.2));
    CHECK(std::max(x0, x1) == doctest::Approx(3).scale(0).epsilon(0.07));
  }
}

TEST_CASE("patches that only come near a line are not sure of it, those far from it have no seam") {
  for (const auto& [gap, seams, sure] :
       {std::tuple{0.0, 1, true}, {0.12, 1, false}, {0.3, 0, false}}) {
    LabelledScan scan;
    scan.add({0, 0, 0}, {3, 0, 0}, {0, 2, 0});
    scan.add({0, 0, gap}, {0, 0, 2}, {3, 0, 0});
    const std::vector<Seam> found = find_seams(scan.patches());
    REQUIRE(static_cast<int>(found.size()) == seams);
    if (seams == 1) CHECK(found[0].sure.empty() == !sure);
  }
}

TEST_CASE("planes that are nearly parallel have a seam only where each is on a side of its own") {
  LabelledScan facets;
  facets.add({0, 0, 0}, {3, 0, 0}, {0, 2, 0});
  facets.add({0, 2, 0}, {3, 0, 0}, {0, 2, 0.1});
  const std::vector<Seam> seams = find_seams(facets.patches());
  REQUIRE(seams.size() == 1);
  REQUIRE(seams[0].sure.size() == 1);
  CHECK(seams[0].sure[0].length() == doctest::Approx(3).epsilon(0.05));
  CHECK(seams[0].line.point.y() == doctest::Approx(2).epsilon(1e-6));

  LabelledScan crossing;
  crossing.add({0, 0, 0}, {3, 0, 0}, {0, 4, 0});
  crossing.add({0, 1.5, -0.025}, {3, 0, 0}, {0, 2, 0.1});
  CHECK(find_seams(crossing.patches()).empty());
}
