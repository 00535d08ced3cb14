// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/describe.h"

#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

TEST_CASE("a surface tells its points, their rms, its coverage and colour") {
  LabelledScan scan;
  const int plate = scan.add({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, -1, 0.004);
  scan.add({0, 0, 1}, {2, 0, 0}, {0, 1, 0});
  const std::size_t count =
      static_cast<std::size_t>(std::count(scan.labels.begin(), scan.labels.end(), plate));
  for (std::size_t i = 0; i < scan.cloud.points.size(); ++i)
    scan.cloud.colors.push_back(i % 2 == 0 ? Color{10, 20, 30} : Color{30, 40, 50});
  // Twice as long as the points reach, with a hole of a quarter where they are.
  const Piece piece{plate,
                    {{{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 1, 0}},
                     {{0.5, 0.25, 0}, {0.5, 0.75, 0}, {1.5, 0.75, 0}, {1.5, 0.25, 0}}}};
  const FoundSurface surface =
      describe(scan.cloud, scan.members(), scan.patches(), scan.planes, {piece})[0];
  CHECK(surface.support.points == count);
  CHECK(surface.support.rms == doctest::Approx(0.004).scale(0).epsilon(0.05));
  // The patch ends a quarter of a metre beyond its points, what is farther does not count.
  CHECK(surface.support.coverage == doctest::Approx(1.5 / 1.75).scale(0).epsilon(0.05));
  REQUIRE(surface.color.has_value());
  CHECK(std::abs(surface.color->r - 20) <= 1);
  CHECK(surface.holes.size() == 1);
  CHECK(surface.plane.normal.z() == doctest::Approx(1));
}
