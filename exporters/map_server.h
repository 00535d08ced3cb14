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

}  // namespace scanworld
