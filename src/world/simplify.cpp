// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "simplify.h"

#include <algorithm>
#include <cmath>

#include "solids.h"
#include "turn.h"

namespace scanworld {

namespace {

// The box with the least footprint of those turned by whole degrees about the upright axis.
OrientedBox upright_box(const std::vector<Vec3>& points, const Vec3& up) {
  const auto stand = turn_between(Vec3::UnitZ(), up);
  OrientedBox best;
  double least = -1;
  for (int degree = 0; degree < 90; ++degree) {
    const Eigen::Quaterniond turn = stand * Eigen::AngleAxisd(degree * M_PI / 180, Vec3::UnitZ());
    Box3 box;
    for (const Vec3& p : points) box.extend(turn.conjugate() * p);
    const double footprint = box.sizes().x() * box.sizes().y();
    if (least >= 0 && footprint >= least) continue;
    least = footprint;
    best = {turn * box.center(), box.sizes(), turn};
  }
  return best;
}

// About the middle of the points' box.
Cylinder upright_cylinder(const std::vector<Vec3>& points, const Vec3& up) {
  const auto stand = turn_between(Vec3::UnitZ(), up);
  Box3 box;
  for (const Vec3& p : points) box.extend(stand.conjugate() * p);
  Cylinder cylinder{stand * box.center(), 0, box.sizes().z()};
  for (const Vec3& p : points)
    cylinder.radius =
        std::max(cylinder.radius, (stand.conjugate() * p - box.center()).head<2>().norm());
  return cylinder;
}

double extent_of(const std::vector<Vec3>& points) {
  Box3 box;
  for (const Vec3& p : points) box.extend(p);
  return box.sizes().maxCoeff();
}

bool is_small(const World& world, const Surface& surface, double size) {
  if (surface.kind != Kind::other) return false;
  std::vector<Vec3> corners;
  for (int v : surface.outer) corners.push_back(world.vertices[static_cast<std::size_t>(v)]);
  return extent_of(corners) < size;
}

}  // namespace

std::variant<OrientedBox, Cylinder> simple_solid(const ConvexHull& hull, const Vec3& up) {
  const OrientedBox box = upright_box(hull.vertices, up);
  const Cylinder cylinder = upright_cylinder(hull.vertices, up);
  if (M_PI * cylinder.radius * cylinder.radius * cylinder.height < box.size.prod()) return cylinder;
  return box;
}

void forget_missing_surfaces(const std::set<int>& kept, World& world) {
  for (Opening& o : world.openings)
    if (o.leaf && !kept.contains(o.leaf->surface)) o.leaf.reset();
  for (Way& way : world.ways)
    for (std::optional<int>& floor : way.floors)
      if (floor && !kept.contains(*floor)) floor.reset();
}

void drop_dangling(World& world) {
  const std::set<int> kept = surface_ids(world);
  std::erase_if(world.colliders, [&](const Collider& c) { return !kept.contains(c.surface); });
  std::erase_if(world.openings, [&](const Opening& o) { return !kept.contains(o.surface); });
  forget_missing_surfaces(kept, world);
  std::set<int> openings;
  for (const Opening& o : world.openings) openings.insert(o.id);
  std::erase_if(world.doors, [&](const Door& d) { return !openings.contains(d.opening); });
  for (Room& room : world.rooms)
    std::erase_if(room.surfaces, [&](int id) { return !kept.contains(id); });
  drop_vertices(world);
}

void drop_vertices(World& world) {
  std::vector<int> index(world.vertices.size(), -1);
  const auto each_loop = [&](auto visit) {
    for (Surface& s : world.surfaces) {
      visit(s.outer);
      for (Loop& hole : s.holes) visit(hole);
    }
    for (Opening& o : world.openings) visit(o.loop);
  };
  each_loop([&](Loop& loop) {
    for (int v : loop) index[static_cast<std::size_t>(v)] = 0;
  });
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < index.size(); ++i)
    if (index[i] == 0) {
      index[i] = static_cast<int>(kept.size());
      kept.push_back(world.vertices[i]);
    }
  world.vertices = std::move(kept);
  each_loop([&](Loop& loop) {
    for (int& v : loop) v = index[static_cast<std::size_t>(v)];
  });
}

std::set<int> surface_ids(const World& world) {
  std::set<int> ids;
  for (const Surface& s : world.surfaces) ids.insert(s.id);
  return ids;
}

World simplify(World world, const SimplifyOptions& options) {
  std::erase_if(world.obstacles, [&](const Obstacle& o) {
    return extent_of(mesh_of(o, world.frame).vertices) < options.min_size;
  });
  if (options.simple_obstacles)
    for (Obstacle& o : world.obstacles)
      if (const auto* hull = std::get_if<ConvexHull>(&o.shape)) {
        const auto solid = simple_solid(*hull, world.frame.up);
        std::visit([&](const auto& shape) { o.shape = shape; }, solid);
      }
  std::erase_if(world.surfaces,
                [&](const Surface& s) { return is_small(world, s, options.min_size); });
  drop_dangling(world);
  return world;
}

}  // namespace scanworld
