// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "obstacles.h"

#include <algorithm>

#include "../parallel.h"
#include "solids.h"

namespace scanworld {

namespace {

// A solid with what it is ranked by.
struct Candidate {
  Solid solid;
  double area = 0;  // [m2]
};

// As it is written: to the micrometre.
Vec3 rounded(const Vec3& v) { return (v * 1e6).array().round() / 1e6; }

Solid rounded(Solid solid) {
  if (auto* box = std::get_if<OrientedBox>(&solid)) {
    box->center = rounded(box->center), box->size = rounded(box->size);
  } else if (auto* hull = std::get_if<ConvexHull>(&solid)) {
    for (Vec3& v : hull->vertices) v = rounded(v);
  } else {
    auto& cylinder = std::get<Cylinder>(solid);
    cylinder.center = rounded(cylinder.center);
    cylinder.radius = std::round(cylinder.radius * 1e6) / 1e6;
    cylinder.height = std::round(cylinder.height * 1e6) / 1e6;
  }
  return solid;
}

std::vector<Candidate> enclose_thing(std::span<const Vec3> thing, double cell, const World& world,
                                     double noise, const SeenSpace& seen,
                                     const ObstacleOptions& options) {
  const Vec3& up = world.frame.up;
  const auto simple_of = [&](std::span<const Vec3> part) {
    auto simple = fit_simple(part, up, noise, options.solid);
    if (simple && !spares_free(*simple, world.frame, part, seen, options.spare)) simple.reset();
    return simple;
  };
  const auto is_simple = [&](std::span<const Vec3> part) { return simple_of(part).has_value(); };
  std::vector<Candidate> found;
  const auto add = [&](const Solid& solid) {
    Candidate c{.solid = rounded(solid)};
    c.area = area_of(mesh_of(Obstacle{.shape = c.solid}, world.frame));
    found.push_back(std::move(c));
  };
  if (const auto simple = simple_of(thing)) {
    add(*simple);
    return found;
  }
  const auto is_possible = [&](const Ellipsoid& e) {
    return spares_free(ConvexHull{corners_of(e, options.solid.max_vertices)}, world.frame, thing,
                       seen, options.spare);
  };
  const RoundParts parts = find_round_parts(thing, cell, noise, options.round, is_possible);
  for (const Ellipsoid& e : parts.found) add(ConvexHull{corners_of(e, options.solid.max_vertices)});
  constexpr std::size_t kCrumb = 12;  // what ellipsoids leave around them
  for (const auto& rest : parts.rest) {
    if (!parts.found.empty() && rest.size() < kCrumb) continue;
    for (const auto& part : split_clutter(rest, up, cell, is_simple, options.split)) {
      Box3 box;
      for (const Vec3& p : part) box.extend(p);
      if (box.sizes().maxCoeff() < options.clutter.min_size) continue;
      const Solid solid = fit_solid(part, up, noise, options.solid);
      if (spares_free(solid, world.frame, part, seen, options.spare)) {
        add(solid);
        continue;
      }
      for (const OrientedBox& b : cover_by_boxes(part, up, cell, noise, options.spare))
        if (b.size.maxCoeff() >= options.clutter.min_size) add(b);
    }
  }
  return found;
}

}  // namespace

Obstacles find_obstacles(const PointCloud& cloud, const std::vector<std::int32_t>& labels,
                         const World& world, const ClutterScale& scale,
                         const ObstacleOptions& options) {
  const Clutter clutter = find_clutter(cloud, labels, world, scale, options.clutter);
  Box3 around;
  for (const Vec3& p : clutter.points) around.extend(p);
  SeenSpace seen;
  if (!clutter.points.empty())
    seen = find_seen_space(cloud, world, around, clutter.cell, options.seen);
  std::vector<std::vector<Candidate>> found(clutter.things());
  parallel_for(found.size(), [&](std::size_t k) {
    found[k] = enclose_thing(clutter.of(k), clutter.cell, world, scale.noise, seen, options);
  });
  std::vector<Candidate> all;
  for (const auto& list : found) all.insert(all.end(), list.begin(), list.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& a, const Candidate& b) { return a.area > b.area; });
  Obstacles obstacles;
  const auto most = static_cast<std::size_t>(options.max_obstacles);
  obstacles.left_out = all.size() - std::min(all.size(), most);
  all.resize(all.size() - obstacles.left_out);
  for (Candidate& c : all)
    obstacles.kept.push_back({static_cast<int>(obstacles.kept.size()), std::move(c.solid)});
  return obstacles;
}

OptionList list_options(ObstacleOptions& o) {
  return {
      {"obstacles.clutter.cell_per_spacing", &o.clutter.cell_per_spacing, "",
       "edge of the cells in which clutter's neighbours are looked for, in spacings", 0.1},
      {"obstacles.clutter.cell_per_noise", &o.clutter.cell_per_noise, "",
       "and at least so many times the noise", 0},
      {"obstacles.clutter.min_cell", &o.clutter.min_cell, "m", "nor is it smaller", 1e-3},
      {"obstacles.clutter.surface_distance", &o.clutter.surface_distance, "noise",
       "points no farther from a surface are not clutter", 0},
      {"obstacles.clutter.min_density", &o.clutter.min_density, "",
       "points of clutter where the spacing of the scan leads to expect one", 0},
      {"obstacles.clutter.min_own_density", &o.clutter.min_own_density, "",
       "and where the middle of the same thing has one", 0},
      {"obstacles.clutter.min_points", &o.clutter.min_points, "",
       "of a thing that stands or hangs on a surface", 4},
      {"obstacles.clutter.min_floating_points", &o.clutter.min_floating_points, "",
       "of one that touches none", 4},
      {"obstacles.clutter.min_size", &o.clutter.min_size, "m", "the longest extent of a thing", 0},
      {"obstacles.round.tolerance", &o.round.tolerance, "noise",
       "points no farther from an ellipsoid lie on it", 0},
      {"obstacles.round.min_points", &o.round.min_points, "",
       "of a thing, one in each cube of half a cell, on an ellipsoid", 12},
      {"obstacles.round.min_seen", &o.round.min_seen, "", "of an ellipsoid's sides, with points", 0,
       1},
      {"obstacles.round.max_unknown", &o.round.max_unknown, "noise",
       "standard deviation of where an ellipsoid's unseen side is", 0},
      {"obstacles.round.max_inside", &o.round.max_inside, "",
       "points deep in an ellipsoid, for each on it", 0},
      {"obstacles.round.max_beside", &o.round.max_beside, "",
       "points a little off an ellipsoid, for each on it", 0},
      {"obstacles.round.max_biased", &o.round.max_biased, "",
       "points where an ellipsoid is off them on the whole, for each on it", 0},
      {"obstacles.round.max_ratio", &o.round.max_ratio, "",
       "of an ellipsoid's longest axis to its shortest", 1},
      {"obstacles.split.min_gain", &o.split.min_gain, "",
       "of a hull's volume that two for its parts leave free", 0, 1},
      {"obstacles.split.min_volume", &o.split.min_volume, "m3", "nor is less worth a solid", 0},
      {"obstacles.split.max_parts", &o.split.max_parts, "", "of one thing", 1},
      {"obstacles.solid.tolerance", &o.solid.tolerance, "noise",
       "points no farther from a face lie on it", 0},
      {"obstacles.solid.min_share", &o.solid.min_share, "",
       "of the points, on the faces of a cylinder or box", 0, 1},
      {"obstacles.solid.min_arc", &o.solid.min_arc, "rad",
       "of a cylinder's side with points, in all", 0},
      {"obstacles.solid.max_empty", &o.solid.max_empty, "",
       "the area of a box in plan is no more than so many times that of its points' hull", 1},
      {"obstacles.solid.max_vertices", &o.solid.max_vertices, "", "of a hull", 6, 1000},
      {"obstacles.seen.max_lines", &o.seen.max_lines, "", "of sight that are followed", 1},
      {"obstacles.seen.max_places", &o.seen.max_places, "",
       "on surfaces that look at each other, where no viewpoint is known", 1},
      {"obstacles.seen.min_cosine", &o.seen.min_cosine, "",
       "of a line between two of them to the normal of either", 0, 1},
      {"obstacles.spare.depth", &o.spare.depth, "m",
       "in an obstacle, from where space that was seen to be free is wrong", 0},
      {"obstacles.spare.min_free", &o.spare.min_free, "m3", "less of it is let pass", 0},
      {"obstacles.spare.min_share", &o.spare.min_share, "",
       "of an obstacle's volume; less free space in it is let pass too", 0, 1},
      {"obstacles.spare.max_deep", &o.spare.max_deep, "",
       "of the points, more than a cell deep in an obstacle, where no viewpoint is known", 0, 1},
      {"obstacles.spare.min_filled", &o.spare.min_filled, "",
       "of the cells of each layer of a box around what no simpler solid spares, with points", 0.01,
       1},
      {"obstacles.spare.min_points", &o.spare.min_points, "",
       "one in each cube of half a cell, that no other such box holds", 1},
      {"obstacles.max_obstacles", &o.max_obstacles, "", "the largest are kept", 0},
  };
}

}  // namespace scanworld
