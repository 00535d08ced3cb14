// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// A robot of one link without inertia, which is how URDF says that something stands still: the
// surfaces to be seen, boxes, cylinders and convex meshes to collide with. The meshes are in a
// folder beside the file, NAME_meshes, that it refers to by relative paths.
void write_urdf(const std::filesystem::path& path, const World& world,
                const ExportOptions& options);

}  // namespace scanworld
