// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/outlines.h"

#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

TEST_CASE("outlines enclose the area of the cells that were chosen") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Patch patch = random_patch(seed);
    const Arrangement arrangement = arrange(patch, random_lines(14, seed));
    Random random(seed);
    std::vector<char> chosen;
    double area = 0, outlined = 0;
    for (const auto& cell : arrangement.cells) {
      chosen.push_back(random.whole(0, 2) > 0);
      if (chosen.back()) area += area_of(arrangement, cell);
    }
    for (const Outline& outline : trace_outlines(arrangement, chosen))
      for (const auto& loop : outline.loops) {
        std::vector<int> ring;
        for (std::size_t k = 0; k < loop.size(); ++k) {
          ring.push_back(loop[k].vertex);
          CHECK(loop[k].line != loop[(k + 1) % loop.size()].line);
        }
        outlined += area_of(arrangement, ring);
      }
    CHECK(outlined == doctest::Approx(area));
  }
}
