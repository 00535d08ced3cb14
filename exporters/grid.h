// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "export_options.h"
#include "occupancy_grid.h"
#include "octree_file.h"

namespace scanworld {

// Writes an occupancy grid as an OctoMap, in its own coordinates: with the odds of each cell (.ot),
// or whether it is free or occupied (.bt).
void write_grid(const std::filesystem::path& path, const OccupancyGrid& grid, OctreeKind kind);

// Makes the grid of a scan and writes it.
void write_scan_grid(const std::filesystem::path& path, const PointCloud& scan,
                     const ExportOptions& options, OctreeKind kind);

}  // namespace scanworld
