// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// Collada and 3MF, by assimp: a node a surface or obstacle, in metres, +Z up.
void write_dae(const std::filesystem::path& path, const World& world, const ExportOptions& options);
void write_3mf(const std::filesystem::path& path, const World& world, const ExportOptions& options);

// Reads a mesh of any format that assimp knows, in the file's own axes, equal vertices joined.
// Throws bad_input naming the file.
Mesh read_mesh(const std::filesystem::path& path);

}  // namespace scanworld
