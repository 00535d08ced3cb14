// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "room_cells.h"

namespace scanworld {

namespace {

// Calls visit(neighbour) for the cells that share a side with one.
template <typename Visit>
void visit_neighbors(const PlanGrid& grid, std::size_t i, const Visit& visit) {
  const std::size_t column = i % grid.columns;
  if (i >= grid.columns) visit(i - grid.columns);
  if (column > 0) visit(i - 1);
  if (column + 1 < grid.columns) visit(i + 1);
  if (i + grid.columns < grid.size()) visit(i + grid.columns);
}

// Dilates lines of `count` cells that are `step` apart in the mask.
void dilate_line(const CellMask& mask, std::size_t first, std::size_t count, std::size_t step,
                 std::size_t radius, CellMask& result) {
  std::size_t reach = 0;  // cells before this one are near the last one of the mask
  for (std::size_t k = 0; k < count; ++k) {
    if (mask[first + k * step]) {
      for (std::size_t j = k - std::min(k, radius); j < k; ++j) result[first + j * step] = 1;
      reach = k + radius + 1;
    }
    if (k < reach) result[first + k * step] = 1;
  }
}

}  // namespace

CellMask dilated(const PlanGrid& grid, const CellMask& mask, std::size_t radius) {
  CellMask rows(mask.size()), both(mask.size());
  for (std::size_t y = 0; y < grid.rows; ++y)
    dilate_line(mask, y * grid.columns, grid.columns, 1, radius, rows);
  for (std::size_t x = 0; x < grid.columns; ++x)
    dilate_line(rows, x, grid.rows, grid.columns, radius, both);
  return both;
}

void grow(const PlanGrid& grid, const CellMask& into, std::size_t steps, Regions& regions) {
  std::vector<std::size_t> front, next;
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (regions.of[i] >= 0) front.push_back(i);
  for (; steps > 0 && !front.empty(); --steps) {
    next.clear();
    for (std::size_t i : front)
      visit_neighbors(grid, i, [&](std::size_t n) {
        if (regions.of[n] >= 0 || !into[n]) return;
        regions.of[n] = regions.of[i];
        ++regions.size[static_cast<std::size_t>(regions.of[i])];
        next.push_back(n);
      });
    front.swap(next);
  }
}

Regions find_regions(const PlanGrid& grid, const CellMask& free, const CellMask& walls,
                     std::size_t radius) {
  const CellMask tight = dilated(grid, walls, radius);
  Regions regions{std::vector<std::int32_t>(grid.size(), -1), {}};
  std::vector<std::size_t> stack;
  const auto take = [&](std::size_t i) {
    if (regions.of[i] >= 0 || !free[i] || tight[i]) return;
    regions.of[i] = static_cast<std::int32_t>(regions.size.size()) - 1;
    ++regions.size.back();
    stack.push_back(i);
  };
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (regions.of[i] >= 0 || !free[i] || tight[i]) continue;
    regions.size.push_back(0);
    for (take(i); !stack.empty();) {
      const std::size_t at = stack.back();
      stack.pop_back();
      visit_neighbors(grid, at, take);
    }
  }
  grow(grid, free, 2 * radius, regions);
  return regions;
}

}  // namespace scanworld
