// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "map_server.h"

#include <fmt/format.h>

#include <map>

#include "cell_walk.h"
#include "error.h"
#include "files.h"
#include "occupancy_grid.h"
#include "parts.h"
#include "world/floor_plan.h"
#include "world/storeys.h"

namespace scanworld {

namespace {

double level_of(const World& world, int storey) {
  if (storey < 0) return main_level(world);
  const std::vector<Storey> storeys = find_storeys(world);
  if (static_cast<std::size_t>(storey) >= storeys.size())
    throw Error(Cause::usage,
                fmt::format("there is no storey {}; there are {}", storey, storeys.size()));
  return storeys[static_cast<std::size_t>(storey)].level;
}

// What map_server loads.
struct MapImage {
  std::string comment, mode;
  PlanGrid grid;
  std::vector<std::uint8_t> pixels;  // of the grid
};

void write_map(const std::filesystem::path& path, const MapImage& map) {
  const PlanGrid& grid = map.grid;
  const std::string name = safe_name(path);
  // 205 stands for a probability of (255 - 205) / 255 = 0.1961: with a free_thresh of 0.25, the
  // default of map_saver for years, what is unknown would be read as free.
  const std::string yaml = fmt::format(
      "# scanworld: {}\nimage: {}.pgm\nmode: {}\nresolution: {}\norigin: [{:.6f}, {:.6f}, 0]\n"
      "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
      map.comment, name, map.mode, grid.cell, grid.corner.x(), grid.corner.y());
  const bool is_image = lower_extension(path) == ".pgm";
  const std::filesystem::path folder = path.parent_path();
  const std::filesystem::path image_path = folder / (name + ".pgm"),
                              text_path = is_image ? folder / (name + ".yaml") : path;
  if (is_image)
    check_replaces_own(text_path, "# scanworld: ");
  else
    check_replaces_own(image_path, "P5\n");
  OutputFile image(image_path), text(text_path);
  image.write(fmt::format("P5\n{} {}\n255\n", grid.columns, grid.rows));
  for (std::size_t row = grid.rows; row-- > 0;)
    image.write(map.pixels.data() + row * grid.columns, grid.columns);
  text.write(yaml);
  image.commit();
  text.commit();
}

// Calls visit(cell, its place) for all known cells of an occupancy grid.
template <typename Visit>
void visit_known(const OccupancyGrid& grid, const Visit& visit) {
  constexpr int kBlock = OccupancyGrid::kBlock;
  for (const OccupancyGrid::Block& block : grid.blocks)
    for (std::size_t i = 0; i < block.cells.size(); ++i)
      if (block.cells[i].is_known())
        visit(block.cells[i], cell_at(block.key * kBlock * kBlock * kBlock + i));
}

// The layer of cells that is the floor.
int floor_layer(const OccupancyGrid& grid) {
  std::map<int, std::size_t> hits;  // cells with points, of each layer
  visit_known(grid, [&](const OccupancyGrid::Cell& cell, const Eigen::Vector3i& at) {
    hits[at.z()] += cell.hits > 0;
  });
  std::size_t most = 0;
  for (const auto& [z, count] : hits) most = std::max(most, count);
  for (const auto& [z, count] : hits)
    if (2 * count >= most) return z;
  return 0;
}

}  // namespace

void write_scan_map(const std::filesystem::path& path, const PointCloud& scan,
                    const ExportOptions& options) {
  const OccupancyGrid grid = make_occupancy_grid(
      scan, {.resolution = options.resolution, .min_points = options.min_points});
  const int floor = floor_layer(grid);
  const double top = (floor + 1) * options.resolution;
  const auto is_in_band = [&](int z) {
    const double height = (z + 0.5) * options.resolution - top;
    return height > options.band_low && height < options.band_high;
  };
  Rectangle box;
  visit_known(grid, [&](const OccupancyGrid::Cell&, const Eigen::Vector3i& at) {
    box.extend(Vec2((at.head<2>().cast<double>().array() + 0.5) * options.resolution));
  });
  if (cell_count(box, options.resolution) > FloorPlanOptions{}.max_cells)
    throw Error(Cause::usage, fmt::format("{}: the scan is too large for a map of {} m cells",
                                          path.string(), options.resolution));
  MapImage map{fmt::format("a scan, from {} m to {} m over its floor at height {:.3f} m",
                           options.band_low, options.band_high, top + scan.origin.z()),
               "raw",
               grid_over(box, options.resolution),
               {}};
  constexpr std::uint8_t kUnknown = 255;
  map.pixels.assign(map.grid.size(), kUnknown);
  visit_known(grid, [&](const OccupancyGrid::Cell& cell, const Eigen::Vector3i& at) {
    if (!is_in_band(at.z())) return;
    const auto i = map.grid.at((at.head<2>().cast<double>().array() + 0.5) * options.resolution);
    const double probability = 1 / (1 + std::exp(-grid.log_odds(cell)));
    const auto percent = static_cast<std::uint8_t>(std::lround(100 * probability));
    std::uint8_t& pixel = map.pixels[*i];
    pixel = pixel == kUnknown ? percent : std::max(pixel, percent);
  });
  map.grid.corner += scan.origin.head<2>();
  write_map(path, map);
}

void write_map_server(const std::filesystem::path& path, const World& world,
                      const ExportOptions& options) {
  const FloorPlanOptions plan_options{.cell = options.resolution,
                                      .low = options.band_low,
                                      .high = options.band_high,
                                      .open_glass = options.open_glass};
  const FloorPlan plan = make_floor_plan(world, level_of(world, options.storey), plan_options);
  MapImage map{fmt::format("the floor at height {:.3f} m, from {} m to {} m over it", plan.level,
                           plan_options.low, plan_options.high),
               "trinary",
               plan.grid,
               {}};
  map.pixels.reserve(plan.cells.size());
  for (const PlanCell cell : plan.cells)
    map.pixels.push_back(cell == PlanCell::occupied ? 0 : cell == PlanCell::free ? 254 : 205);
  write_map(path, map);
}

}  // namespace scanworld
