// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "occupancy_grid.h"

namespace scanworld {

// Writes an occupancy grid as an OctoMap, in its own coordinates: with the odds of each cell (.ot),
// or whether it is free or occupied (.bt).
void write_grid(const std::filesystem::path& path, const OccupancyGrid& grid);

}  // namespace scanworld
