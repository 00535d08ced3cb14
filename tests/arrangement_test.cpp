// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/arrangement.h"

#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

TEST_CASE("cells are convex, fill the rectangle and share their sides") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Patch patch = random_patch(seed);
    const Arrangement arrangement = arrange(patch, random_lines(12, seed));
    double area = 0, says = 0;
    for (std::size_t c = 0; c < arrangement.cells.size(); ++c) {
      const auto& cell = arrangement.cells[c];
      area += area_of(arrangement, cell);
      says += cell.covered - cell.empty;
      for (std::size_t k = 0; k < cell.sides.size(); ++k) {
        const auto& side = cell.sides[k];
        CHECK(side.to == cell.sides[(k + 1) % cell.sides.size()].from);
        const auto at = [&](int v) { return arrangement.vertices[static_cast<std::size_t>(v)]; };
        const Vec2 a = at(side.to) - at(side.from),
                   b = at(cell.sides[(k + 1) % cell.sides.size()].to) - at(side.to);
        CHECK(a.x() * b.y() - a.y() * b.x() > -1e-6);
        if (side.across < 0) {
          const Vec2 m = (at(side.from) + at(side.to)) / 2;
          CHECK(std::min({m.x(), m.y(), 4 - m.x(), 3 - m.y()}) < 1e-6);
          continue;
        }
        const auto& back = arrangement.cells[static_cast<std::size_t>(side.across)].sides;
        CHECK(std::count_if(back.begin(), back.end(), [&](const auto& s) {
                return s.from == side.to && s.to == side.from && s.across == static_cast<int>(c);
              }) == 1);
      }
    }
    CHECK(area == doctest::Approx(12));
    double all = 0;
    for (float e : patch.evidence) all += 0.01 * static_cast<double>(e);
    CHECK(says == doctest::Approx(all));
  }
}

TEST_CASE("a line cuts cells that its reach runs through, and no others") {
  const Patch patch = blank_patch({4, 3}, 0.1);
  const CutLine wall = line_through({2, -1}, {2, 4}, 1), stub = line_through({0.5, 1}, {1.5, 1}, 2);
  CHECK(arrange(patch, {wall, stub}).cells.size() == 3);
  CHECK(arrange(patch, {stub, wall}).cells.size() == 4);
}
