// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// MJCF, the format of MuJoCo, in one file: boxes, cylinders and convex meshes in the world body
// (group 3), as MuJoCo takes the hull of whatever it collides with; and the surfaces to be seen and
// met by rays (group 2), each as a closed sheet of 1 mm, as MuJoCo refuses meshes without volume.
// Obstacles are both (group 0).
void write_mjcf(const std::filesystem::path& path, const World& world,
                const ExportOptions& options);

}  // namespace scanworld
