// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "map_server.h"

#include <fmt/format.h>

#include "error.h"
#include "files.h"
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

std::string pgm_of(const FloorPlan& plan) {
  const PlanGrid& grid = plan.grid;
  std::string text = fmt::format("P5\n{} {}\n255\n", grid.columns, grid.rows);
  text.reserve(text.size() + grid.size());
  for (std::size_t row = grid.rows; row-- > 0;)
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const PlanCell cell = plan.cells[row * grid.columns + column];
      text += static_cast<char>(cell == PlanCell::occupied ? 0
                                : cell == PlanCell::free   ? 254
                                                           : 205);
    }
  return text;
}

}  // namespace

void write_map_server(const std::filesystem::path& path, const World& world,
                      const ExportOptions& options) {
  const FloorPlanOptions plan_options{.cell = options.resolution,
                                      .low = options.band_low,
                                      .high = options.band_high,
                                      .open_glass = options.open_glass};
  const FloorPlan plan = make_floor_plan(world, level_of(world, options.storey), plan_options);
  const std::string name = safe_name(path);
  std::string yaml =
      fmt::format("# scanworld: the floor at height {:.3f} m, from {} m to {} m over it\n",
                  plan.level, plan_options.low, plan_options.high);
  // 205 stands for a probability of (255 - 205) / 255 = 0.1961: with a free_thresh of 0.25, the
  // default of map_saver for years, what is unknown would be read as free.
  yaml += fmt::format(
      "image: {}.pgm\nmode: trinary\nresolution: {}\norigin: [{:.6f}, {:.6f}, 0]\nnegate: 0\n"
      "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
      name, options.resolution, plan.grid.corner.x(), plan.grid.corner.y());
  const bool is_image = lower_extension(path) == ".pgm";
  OutputFile image(path.parent_path() / (name + ".pgm")),
      text(is_image ? path.parent_path() / (name + ".yaml") : path);
  image.write(pgm_of(plan));
  text.write(yaml);
  image.commit();
  text.commit();
}

}  // namespace scanworld
