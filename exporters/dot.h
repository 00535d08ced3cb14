// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// Writes the topological map as an undirected graph for Graphviz: a node a room, labelled with name
// and area, an edge a door, labelled with its width. `pos` has the centres, an inch a metre, so
// that neato draws the rooms where they are; `area`, `opening`, `door_width` and `length` [m2, m]
// are for programs.
void write_dot(const std::filesystem::path& path, const World& world, const ExportOptions& options);

}  // namespace scanworld
