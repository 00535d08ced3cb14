// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bodies.h"

namespace scanworld {

// The file of all that is to be seen, in the folder of meshes.
inline constexpr const char* kVisualMesh = "surfaces.obj";

// The file of a convex body in the folder, in the body's own axes.
std::string mesh_file_of(const ExportBody& body);

// The folder of meshes that formats refer to: surfaces.obj with its colours, and one OBJ a convex
// body. It appears whole or not at all, in place of an older one.
void write_mesh_folder(const std::filesystem::path& folder, const World& world,
                       const std::vector<ExportBody>& bodies, const ExportOptions& options);

}  // namespace scanworld
