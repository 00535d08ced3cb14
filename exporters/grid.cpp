// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "grid.h"

#include <algorithm>

namespace scanworld {

namespace {

// Adds the cells of a block, of which there are 8^level in Morton order.
OctreeNode add_cells(const OccupancyGrid& grid, const OccupancyGrid::Cell* cells, int level,
                     OctreeNodes& out) {
  if (level == 0) return cells->is_known() ? out.add_leaf(grid.log_odds(*cells)) : OctreeNode{};
  const std::size_t opened = out.open();
  std::array<OctreeNode, 8> children;
  for (std::size_t k = 0; k < 8; ++k)
    children[k] = add_cells(grid, cells + (k << 3 * (level - 1)), level - 1, out);
  return out.close(opened, children);
}

// Adds the cube of 2^level blocks along each edge that begins at the block of this name.
OctreeNode add_blocks(const OccupancyGrid& grid, std::uint64_t first, int level, OctreeNodes& out) {
  const auto block =
      std::partition_point(grid.blocks.begin(), grid.blocks.end(),
                           [&](const OccupancyGrid::Block& b) { return b.key < first; });
  if (block == grid.blocks.end() || block->key >> 3 * level != first >> 3 * level) return {};
  if (level == 0) return add_cells(grid, block->cells.data(), 3, out);
  const std::size_t opened = out.open();
  std::array<OctreeNode, 8> children;
  for (std::size_t k = 0; k < 8; ++k)
    children[k] = add_blocks(grid, first + (k << 3 * (level - 1)), level - 1, out);
  return out.close(opened, children);
}

}  // namespace

void write_grid(const std::filesystem::path& path, const OccupancyGrid& grid, OctreeKind kind) {
  OctreeNodes nodes(kind);
  add_blocks(grid, 0, kOctreeDepth - 3, nodes);
  nodes.write(path, grid.options.resolution, {.origin = grid.origin});
}

void write_scan_grid(const std::filesystem::path& path, const PointCloud& scan,
                     const ExportOptions& options, OctreeKind kind) {
  write_grid(path,
             make_occupancy_grid(
                 scan, {.resolution = options.resolution, .min_points = options.min_points}),
             kind);
}

}  // namespace scanworld
