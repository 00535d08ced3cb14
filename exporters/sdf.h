// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// SDF 1.7, read by Gazebo 11 and all that came after: the file is a world with sun and gravity that
// includes a model, NAME_model, written beside it as Gazebo wants it (model.config, model.sdf,
// meshes/). The surfaces are its visual; boxes, cylinders and convex meshes its collisions.
void write_sdf(const std::filesystem::path& path, const World& world, const ExportOptions& options);

}  // namespace scanworld
