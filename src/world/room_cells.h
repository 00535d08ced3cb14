// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "plan_grid.h"

namespace scanworld {

using CellMask = std::vector<std::uint8_t>;  // for each cell of a grid 0 or 1

// The cells that have one of a mask within `radius` cells along both axes.
CellMask dilated(const PlanGrid& grid, const CellMask& mask, std::size_t radius);

// Cells in regions, numbered in the order of their first cells; -1 where there is none.
struct Regions {
  std::vector<std::int32_t> of;   // for each cell
  std::vector<std::size_t> size;  // cells of each region
};

// The regions of free cells that hang together over sides of cells, where no wall is within
// `radius` cells; each then has the free cells that are nearest to it, up to twice that far.
Regions find_regions(const PlanGrid& grid, const CellMask& free, const CellMask& walls,
                     std::size_t radius);

// Lets regions grow by `steps` cells into cells of a mask that are in none.
void grow(const PlanGrid& grid, const CellMask& into, std::size_t steps, Regions& regions);

}  // namespace scanworld
