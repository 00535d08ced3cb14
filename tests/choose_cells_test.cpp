// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/choose_cells.h"

#include "support/patches.h"
#include "surface/outlines.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

TEST_CASE("the cells that are chosen have the lowest price of all choices") {
  const ChoiceOptions options;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Patch patch = random_patch(seed);
    std::vector<CutLine> lines = random_lines(3, seed);
    for (CutLine& line : lines) line.seen.clear();  // so that all outlines cost the same
    const Arrangement arrangement = arrange(patch, lines);
    const std::size_t count = arrangement.cells.size();
    REQUIRE(count <= 10);
    const auto price = [&](const std::vector<char>& chosen) {
      double sum = 0;
      for (std::size_t c = 0; c < count; ++c) {
        const auto& cell = arrangement.cells[c];
        sum += chosen[c] ? cell.empty : cell.covered;
        if (!chosen[c]) continue;
        for (const auto& side : cell.sides)
          if (side.across < 0 || !chosen[static_cast<std::size_t>(side.across)])
            sum += options.open_price * (arrangement.vertices[static_cast<std::size_t>(side.to)] -
                                         arrangement.vertices[static_cast<std::size_t>(side.from)])
                                            .norm();
      }
      return sum;
    };
    double best = 1e9;
    for (unsigned set = 0; set < 1u << count; ++set) {
      std::vector<char> chosen(count);
      for (std::size_t c = 0; c < count; ++c) chosen[c] = set >> c & 1;
      best = std::min(best, price(chosen));
    }
    CHECK(price(choose_cells(arrangement, lines, patch.frame, options)) == doctest::Approx(best));
  }
}

TEST_CASE("an outline runs along a line that is seen rather than beside it") {
  Patch patch = blank_patch({4, 3}, 0.1);
  // Points up to 2.02 m, beyond the line that tells where the end is.
  for (std::size_t i = 0; i < patch.evidence.size(); ++i)
    if (patch.middle[i].x() < 2.1 && patch.middle[i].y() > 0.5 && patch.middle[i].y() < 2.5)
      patch.evidence[i] = 1;
  const std::vector<CutLine> lines = {
      line_through({2, 0}, {2, 3}, 1), line_through({2.3, 0}, {2.3, 3}, 2),
      line_through({0, 0.5}, {4, 0.5}, 3), line_through({0, 2.5}, {4, 2.5}, 4)};
  const Arrangement arrangement = arrange(patch, lines);
  const auto outlines = trace_outlines(arrangement, choose_cells(arrangement, lines, patch.frame));
  REQUIRE(outlines.size() == 1);
  REQUIRE(outlines[0].loops.size() == 1);
  CHECK(outlines[0].loops[0].size() == 4);
  std::vector<int> ring;
  for (const auto& corner : outlines[0].loops[0]) ring.push_back(corner.vertex);
  CHECK(area_of(arrangement, ring) == doctest::Approx(4));
}
