// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// Writes the floor plan of a storey for map_server of ROS: YAML, and beside it under the same name
// PGM (P5, the first row that of the largest y) with 0 for occupied, 254 for free and 205 for
// unknown cells. The YAML's origin is the lower left corner of the plan, in the axes of the world
// made upright. Throws usage where the map would be too large, or where there is no such storey.
void write_map_server(const std::filesystem::path& path, const World& world,
                      const ExportOptions& options);

// The same straight from a scan, whose z is up: each cell has how likely one of the occupancy
// grid's cells over it, in the band, is occupied (mode raw: 0 to 100 per cent, 255 for unknown).
// Free cells need viewpoints. The floor is the lowest layer of cells with at least half as many
// hits as the fullest one.
void write_scan_map(const std::filesystem::path& path, const PointCloud& scan,
                    const ExportOptions& options);

}  // namespace scanworld
