// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// USD as text, in metres: under one root prim the surfaces as meshes and the solids as static
// UsdPhysics colliders (cubes, cylinders, convex hulls) that are not rendered.
void write_usda(const std::filesystem::path& path, const World& world,
                const ExportOptions& options);

}  // namespace scanworld
