// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "assemble.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "surface_rings.h"
#include "vertex_pool.h"

namespace scanworld {

namespace {

struct HeightRange {
  double low, high;
};

HeightRange heights(const World& world, const Surface& surface) {
  HeightRange range{1e300, -1e300};
  for (int index : surface.outer) {
    const double h = world.frame.up.dot(world.vertices[static_cast<std::size_t>(index)]);
    range = {std::min(range.low, h), std::max(range.high, h)};
  }
  return range;
}

Vec3 middle_of(const World& world, const Surface& surface) {
  Vec3 sum = Vec3::Zero();
  for (int index : surface.outer) sum += world.vertices[static_cast<std::size_t>(index)];
  return sum / static_cast<double>(surface.outer.size());
}

Box3 box_of(const World& world, const Surface& surface) {
  Box3 box;
  for (int index : surface.outer) box.extend(world.vertices[static_cast<std::size_t>(index)]);
  return box;
}

// The least share of a surface's outline where neighbours are against it, for it to be turned.
constexpr double kMinOpposed = 1.0 / 3;

// Calls visit(a, b) for the edges of a surface, in the direction of its loops.
template <typename Visit>
void visit_edges(const Surface& surface, const Visit& visit) {
  const auto along = [&](const Loop& loop) {
    for (std::size_t k = 0; k < loop.size(); ++k) visit(loop[k], loop[(k + 1) % loop.size()]);
  };
  along(surface.outer);
  for (const Loop& hole : surface.holes) along(hole);
}

void turn_over(Surface& surface) {
  surface.plane = surface.plane.flipped();
  std::reverse(surface.outer.begin(), surface.outer.end());
  for (Loop& hole : surface.holes) std::reverse(hole.begin(), hole.end());
  for (InferredPart& part : surface.inferred) {
    std::reverse(part.outer.begin(), part.outer.end());
    for (auto& hole : part.holes) std::reverse(hole.begin(), hole.end());
  }
}

bool is_within_outline(const World& world, const Surface& surface, const Vec3& p) {
  const PlaneFrame frame = rings_frame(world, surface);
  return is_inside({ring_of(world, surface.outer, frame)}, frame.to_plane(p));
}

}  // namespace

void agree_with_neighbors(World& world) {
  // The directions in which surfaces go along each edge, by how often.
  std::map<std::pair<int, int>, int> sides;
  const auto count = [&](const Surface& s, int by) {
    visit_edges(s, [&](int a, int b) { sides[{a, b}] += by; });
  };
  for (const Surface& s : world.surfaces) count(s, 1);
  std::vector<std::size_t> order(world.surfaces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return world.surfaces[a].support.points < world.surfaces[b].support.points;
  });
  for (const std::size_t i : order) {
    Surface& s = world.surfaces[i];
    double agreed = 0, opposed = 0, around = 0;
    visit_edges(s, [&](int a, int b) {
      const double length = (world.vertices[static_cast<std::size_t>(b)] -
                             world.vertices[static_cast<std::size_t>(a)])
                                .norm();
      const int same = sides[{a, b}] - 1, other = sides[{b, a}];
      around += length;
      if (same + other != 1) return;  // an open edge, or one where three or more meet
      (other == 1 ? agreed : opposed) += length;
    });
    if (agreed > 0 || opposed < kMinOpposed * around) continue;
    count(s, -1);
    turn_over(s);
    count(s, 1);
  }
}

World assemble_world(const std::vector<FoundSurface>& surfaces, const Frame& frame) {
  World world{.frame = frame};
  VertexPool pool(world.vertices);
  for (const FoundSurface& found : surfaces) {
    Surface surface{.id = static_cast<int>(world.surfaces.size()),
                    .source = found.source,
                    .plane = found.plane,
                    .outer = pool.add(found.outer),
                    .thickness = found.thickness,
                    .support = found.support,
                    .color = found.color,
                    .curve = found.curve,
                    .inferred = found.inferred};
    for (const auto& hole : found.holes) surface.holes.push_back(pool.add(hole));
    world.surfaces.push_back(std::move(surface));
  }
  agree_with_neighbors(world);
  classify(world);
  return world;
}

void classify(World& world, const ClassifyOptions& options) {
  const double level = std::cos(options.max_tilt), upright = std::sin(options.max_tilt);
  const auto rise = [&](const Surface& s) { return s.plane.normal.dot(world.frame.up); };
  const auto stands_on_another = [&](const Surface& s) {
    const Vec3 middle = middle_of(world, s);
    return std::any_of(world.surfaces.begin(), world.surfaces.end(), [&](const Surface& other) {
      if (&other == &s || rise(other) <= level || area(world, other) <= area(world, s))
        return false;
      const double above = other.plane.signed_distance(middle) / rise(other);
      if (above < options.min_table_height || above > options.max_table_height) return false;
      const Vec3 below = middle - above * world.frame.up;
      if (area(world, s) > options.max_table_area) return is_within_outline(world, other, below);
      // Its bounding box is enough: a floor ends before what stands on it and hides it.
      return box_of(world, other).exteriorDistance(below) < 0.1;
    });
  };
  for (Surface& s : world.surfaces) {
    const HeightRange range = heights(world, s);
    if (rise(s) > level)
      s.kind = stands_on_another(s) ? Kind::other : Kind::floor;
    else if (rise(s) < -level)
      s.kind = Kind::ceiling;
    else if (std::abs(rise(s)) < upright && range.high - range.low >= options.min_wall_height)
      s.kind = Kind::wall;
    else
      s.kind = Kind::other;
  }
}

}  // namespace scanworld
