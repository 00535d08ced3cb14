// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// Writes binary glTF 2.0 (GLB): a named node and mesh for each surface and obstacle, with its id in
// `extras`. glTF is Y-up, so (x, y, z) is written as (x, z, -y), in the vertices themselves.
// Metres. With the option `physics` also the solids, as static colliders.
void write_glb(const std::filesystem::path& path, const World& world, const ExportOptions& options);

}  // namespace scanworld
