// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// Writes a PLY mesh (binary, little-endian): double vertices that neighbouring surfaces share,
// faces with the colour and the `int surface_id` of their surface (-1 for obstacles).
void write_ply_mesh(const std::filesystem::path& path, const World& world,
                    const ExportOptions& options);

// A mesh alone, binary, its coordinates in double.
void write_ply_mesh(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace scanworld
