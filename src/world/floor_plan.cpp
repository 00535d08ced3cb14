// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "floor_plan.h"

#include <fmt/format.h>

#include "../error.h"
#include "../polygon.h"
#include "convex_parts.h"
#include "level.h"
#include "solids.h"
#include "storeys.h"
#include "triangulate.h"

namespace scanworld {

namespace {

// What of a convex polygon is between two heights.
std::vector<Vec3> slice(const std::vector<Vec3>& ring, double low, double high) {
  return clipped<Vec3>(clipped<Vec3>(ring, Vec3::UnitZ(), high), -Vec3::UnitZ(), -low);
}

std::vector<Vec2> seen_from_above(const std::vector<Vec3>& ring) {
  std::vector<Vec2> plan;
  for (const Vec3& p : ring) plan.push_back(p.head<2>());
  return plan;
}

class Plotter {
 public:
  Plotter(const World& world, double level, const FloorPlanOptions& options)
      : world_(world), options_(options), low_(level + options.low), high_(level + options.high) {
    plan_.level = level;
    plan_.upright = upright_turn(world.frame);
    turned_.reserve(world.vertices.size());
    for (const Vec3& v : world.vertices) turned_.push_back(plan_.upright * v);
    for (const Obstacle& o : world.obstacles) obstacles_.push_back(mesh_of(o, world.frame));
    make_grid();
  }

  FloorPlan plot() && {
    const WorldMesh mesh = triangulate(world_);
    for (std::size_t i = 0; i < mesh.surface.size(); ++i) {
      std::vector<Vec3> ring;
      for (int v : mesh.mesh.triangles[i]) ring.push_back(turned_[static_cast<std::size_t>(v)]);
      const auto s = static_cast<std::size_t>(mesh.surface[i]);
      add_floor(ring, world_.surfaces[s].plane);
      add_face(ring, world_.surfaces[s].plane);
    }
    for (const Mesh& obstacle : obstacles_) add_solid(obstacle);
    for (const Collider& c : world_.colliders)
      add_solid(std::visit([](const auto& shape) { return mesh_of(shape); }, c.shape));
    for (const Opening& o : world_.openings)
      if (o.glass && !options_.open_glass) add_pane(o);
    return std::move(plan_);
  }

 private:
  void make_grid() {
    Rectangle box;
    for (const Vec3& v : turned_) box.extend(Vec2(v.head<2>()));
    for (const Mesh& obstacle : obstacles_)
      for (const Vec3& v : obstacle.vertices) box.extend(Vec2((plan_.upright * v).head<2>()));
    const double count = cell_count(box, options_.cell);
    if (!(count <= options_.max_cells))
      throw Error(
          Cause::usage,
          fmt::format("a plan of {:.0f} m by {:.0f} m would have {:.0f} cells of {} m, more "
                      "than {:.0f}: larger cells are needed",
                      box.sizes().x(), box.sizes().y(), count, options_.cell, options_.max_cells));
    plan_.grid = grid_over(box, options_.cell);
    plan_.cells.resize(plan_.grid.size());
  }

  // The cells whose inside a convex ring reaches: what only ends at the line between two is not in
  // both.
  void occupy(std::vector<Vec2> ring) {
    Vec2 middle = Vec2::Zero();
    for (const Vec2& p : ring) middle += p / static_cast<double>(ring.size());
    for (Vec2& p : ring) p += kBehindFace * (middle - p).normalized();
    visit_touched(plan_.grid, ring, [&](std::size_t i) { plan_.cells[i] = PlanCell::occupied; });
  }

  void add_floor(const std::vector<Vec3>& ring, const Plane& plane) {
    if (plane.normal.dot(world_.frame.up) < std::cos(options_.max_slope)) return;
    const auto part = slice(ring, plan_.level - options_.low, low_);
    visit_covered(plan_.grid, seen_from_above(part), [&](std::size_t i) {
      if (plan_.cells[i] == PlanCell::unknown) plan_.cells[i] = PlanCell::free;
    });
  }

  void add_face(const std::vector<Vec3>& ring, const Plane& plane) {
    std::vector<Vec3> part = slice(ring, low_, high_);
    const Vec3 behind = plan_.upright * plane.normal * -kBehindFace;
    for (Vec3& p : part) p += behind;
    occupy(seen_from_above(part));
  }

  void add_pane(const Opening& opening) {
    std::vector<Vec3> ring;
    for (int v : opening.loop) ring.push_back(turned_[static_cast<std::size_t>(v)]);
    const auto part = slice(ring, low_, high_);
    // Loops need not be convex, but seen from above they are a line, or nearly.
    if (!part.empty()) occupy(convex_hull(seen_from_above(part)));
  }

  // A convex solid, as a whole.
  void add_solid(const Mesh& solid) {
    std::vector<Vec2> outline;
    for (const auto& t : solid.triangles) {
      std::vector<Vec3> ring;
      for (int v : t) ring.push_back(plan_.upright * solid.vertices[static_cast<std::size_t>(v)]);
      for (const Vec3& p : slice(ring, low_, high_)) outline.push_back(p.head<2>());
    }
    if (!outline.empty()) occupy(convex_hull(std::move(outline)));
  }

  const World& world_;
  const FloorPlanOptions& options_;
  const double low_, high_;
  FloorPlan plan_;
  std::vector<Vec3> turned_;  // the world's vertices
  std::vector<Mesh> obstacles_;
};

}  // namespace

FloorPlan make_floor_plan(const World& world, double level, const FloorPlanOptions& options) {
  return Plotter(world, level, options).plot();
}

FloorPlan make_floor_plan(const World& world, const FloorPlanOptions& options) {
  return make_floor_plan(world, main_level(world), options);
}

}  // namespace scanworld
