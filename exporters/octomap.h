// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "export_options.h"
#include "octree_file.h"
#include "world/world.h"

namespace scanworld {

// Writes a world as an OctoMap, metres, in the world's frame.
//
// Occupied is every cell that has some of a surface, a pane of glass (a robot does not go
// through it; a lidar would: options.open_glass) or an obstacle in it, or next
// to it behind its face, and the inside of obstacles. Of the others those are free that the front
// of a surface faces, with nothing between, within the bounds of the world (rounded out to 16
// cells). All else is unknown: the inside of walls, what is behind surfaces, and outside.
//
// Throws usage naming the file, the value and what would do, where the world is too large for the
// resolution: for the tree, or for more than some 100 million cells.
void write_octomap(const std::filesystem::path& path, const World& world,
                   const ExportOptions& options, OctreeKind kind);

}  // namespace scanworld
