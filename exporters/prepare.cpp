// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>

#include "bodies.h"
#include "error.h"
#include "export.h"
#include "world/colliders.h"
#include "world/level.h"
#include "world/rooms.h"
#include "world/thickness.h"

namespace scanworld {

namespace {

void check(const char* what, std::size_t count, std::size_t most) {
  if (most > 0 && count > most)
    throw Error(Cause::usage,
                fmt::format("the world has {} {}, and the budget is {}", count, what, most));
}

void check_budget(const World& world, const ExportOptions& options) {
  const ExportBudget& budget = options.budget;
  if (budget == ExportBudget{}) return;
  std::size_t hulls = 0, vertices = 0;
  const std::vector<ExportBody> bodies = export_bodies(world, options);
  for (const ExportBody& body : bodies)
    if (const auto* convex = std::get_if<ConvexShape>(&body.shape)) {
      ++hulls;
      vertices = std::max(vertices, convex->mesh.vertices.size());
    }
  check("solids", bodies.size(), budget.solids);
  check("hulls", hulls, budget.hulls);
  check("vertices in one hull", vertices, budget.hull_vertices);
  check("triangles", triangle_count(world), budget.faces);
}

}  // namespace

ExportBudget budget_from(const std::string& text) {
  ExportBudget budget;
  const std::pair<const char*, std::size_t*> caps[] = {{"faces", &budget.faces},
                                                       {"solids", &budget.solids},
                                                       {"hulls", &budget.hulls},
                                                       {"hull_vertices", &budget.hull_vertices}};
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    const std::string cap = text.substr(from, to - from);
    bool is_known = false;
    for (const auto& [name, value] : caps) {
      const std::string start = std::string(name) + "=";
      if (!cap.starts_with(start)) continue;
      const char *begin = cap.data() + start.size(), *end = cap.data() + cap.size();
      is_known = begin != end && std::from_chars(begin, end, *value).ptr == end && *value > 0;
    }
    if (!is_known)
      throw Error(Cause::usage, fmt::format("--budget: '{}' is no cap; write faces=N, solids=N, "
                                            "hulls=N or hull_vertices=N, joined by commas",
                                            cap));
    from = to + 1;
  }
  return budget;
}

World prepare_export(World world, const ExportOptions& options) {
  world = level_world(std::move(world), {.level = options.level});
  if (!options.origin.isZero())
    world = moved(std::move(world), Eigen::Quaterniond::Identity(), -options.origin);
  if (world.colliders.empty()) {
    set_thickness(world, pair_faces(world));
    world.colliders = make_colliders(world);
  }
  if (world.rooms.empty()) set_rooms(world, find_rooms(world));
  // Last, as solids and rooms are made of the whole.
  world = leave_out(std::move(world), options.without);
  if (!options.without.empty() && world.surfaces.empty() && world.obstacles.empty())
    throw Error(Cause::usage, "--without leaves nothing of the world: no surface and no obstacle");
  if (options.color_by_kind)
    for (Surface& s : world.surfaces) s.color.reset();
  check_budget(world, options);
  if (options.y_up) world = moved(std::move(world), y_up_turn(), Vec3::Zero());
  return world;
}

}  // namespace scanworld
