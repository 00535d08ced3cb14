// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// Writes all surfaces and obstacles as binary STL, metres, in the world's frame. The format has
// neither units, names nor shared vertices.
void write_stl(const std::filesystem::path& path, const World& world, const ExportOptions& options);

}  // namespace scanworld
