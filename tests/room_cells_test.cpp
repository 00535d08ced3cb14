// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/room_cells.h"

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// A grid and masks from a drawing: '.' free, '#' wall, ' ' neither.
struct Drawing {
  PlanGrid grid;
  CellMask free, walls;

  explicit Drawing(const std::vector<std::string>& lines) {
    grid = {.cell = 1, .columns = lines[0].size(), .rows = lines.size()};
    for (const std::string& line : lines)
      for (const char c : line) free.push_back(c == '.'), walls.push_back(c == '#');
  }
};

}  // namespace

TEST_CASE("a dilated mask has the cells within a square of those it had") {
  Random random(5);
  const PlanGrid grid{.cell = 1, .columns = 23, .rows = 17};
  for (std::size_t radius = 0; radius < 5; ++radius) {
    CellMask mask(grid.size());
    for (auto& m : mask) m = random.whole(0, 40) == 0;
    const CellMask wide = dilated(grid, mask, radius);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      bool is_near = false;
      for (std::size_t j = 0; j < grid.size(); ++j) {
        const Vec2 apart = (grid.center(i) - grid.center(j)).cwiseAbs();
        is_near |= mask[j] && apart.maxCoeff() < static_cast<double>(radius) + 0.5;
      }
      CHECK(wide[i] == is_near);
    }
  }
}

TEST_CASE("a gap that is too narrow parts regions, a wide one does not") {
  const std::vector<std::string> narrow = {"###############", "#......#......#", "#......#......#",
                                           "#.............#", "#......#......#", "#......#......#",
                                           "###############"};
  const Drawing d(narrow);
  CHECK(find_regions(d.grid, d.free, d.walls, 0).size == std::vector<std::size_t>{61});
  const Regions parted = find_regions(d.grid, d.free, d.walls, 1);
  REQUIRE(parted.size.size() == 2);
  CHECK(parted.size[0] + parted.size[1] == 61);
  CHECK(parted.of[1 * 15 + 1] == 0);
  CHECK(parted.of[5 * 15 + 13] == 1);
  CHECK(find_regions(d.grid, d.free, d.walls, 3).size.empty());
}

TEST_CASE("regions are made of free cells alone, and tell their sizes") {
  Random random(6);
  for (int k = 0; k < 20; ++k) {
    std::vector<std::string> lines(20, std::string(30, '.'));
    for (auto& line : lines)
      for (char& c : line)
        if (const int dice = random.whole(0, 15); dice < 2) c = dice ? '#' : ' ';
    const Drawing d(lines);
    const Regions regions = find_regions(d.grid, d.free, d.walls, 1);
    std::vector<std::size_t> counts(regions.size.size());
    for (std::size_t i = 0; i < d.grid.size(); ++i) {
      if (regions.of[i] < 0) continue;
      CHECK(d.free[i] == 1);
      ++counts[static_cast<std::size_t>(regions.of[i])];
    }
    CHECK(counts == regions.size);
  }
}

TEST_CASE("regions grow no farther than asked, and only where they may") {
  const Drawing d({"....... ..", "##########"});
  Regions regions{std::vector<std::int32_t>(d.grid.size(), -1), {1}};
  regions.of[0] = 0;
  grow(d.grid, d.free, 3, regions);
  CHECK(regions.size[0] == 4);
  grow(d.grid, d.free, 100, regions);
  CHECK(regions.size[0] == 7);
  CHECK(regions.of[8] == -1);
}
