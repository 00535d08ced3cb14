// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// Writes the topological map as GraphML 1.0: a node a room with name, area [m2] and centre [m], an
// undirected edge a door with opening, kind, width, height and length [m]. What is not known is
// left out.
void write_graphml(const std::filesystem::path& path, const World& world,
                   const ExportOptions& options);

}  // namespace scanworld
