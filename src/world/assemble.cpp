// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "assemble.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace scanworld {

namespace {

// Gives equal points one index.
class VertexPool {
 public:
  explicit VertexPool(std::vector<Vec3>& vertices) : vertices_(vertices) {}

  Loop add(const std::vector<Vec3>& ring) {
    Loop loop;
    for (const Vec3& v : ring) {
      const int index = add(v);
      if (loop.empty() || (index != loop.back() && index != loop.front())) loop.push_back(index);
    }
    return loop;
  }

 private:
  int add(const Vec3& v) {
    const std::array<std::int64_t, 3> um = {std::llround(v.x() * 1e6), std::llround(v.y() * 1e6),
                                            std::llround(v.z() * 1e6)};
    const auto [found, is_new] = index_.try_emplace(um, static_cast<int>(vertices_.size()));
    if (is_new)
      vertices_.emplace_back(static_cast<double>(um[0]) / 1e6, static_cast<double>(um[1]) / 1e6,
                             static_cast<double>(um[2]) / 1e6);
    return found->second;
  }

  std::vector<Vec3>& vertices_;
  std::map<std::array<std::int64_t, 3>, int> index_;
};

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

}  // namespace

World assemble_world(const std::vector<FoundSurface>& surfaces, const Frame& frame) {
  World world{.frame = frame};
  VertexPool pool(world.vertices);
  for (const FoundSurface& found : surfaces) {
    Surface surface{.id = static_cast<int>(world.surfaces.size()),
                    .source = found.source,
                    .plane = found.plane,
                    .outer = pool.add(found.outer),
                    .support = found.support,
                    .color = found.color};
    for (const auto& hole : found.holes) surface.holes.push_back(pool.add(hole));
    world.surfaces.push_back(std::move(surface));
  }
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
      // Its bounding box is enough: a floor ends before what stands on it and hides it.
      return above > 0 && above < options.max_table_height &&
             box_of(world, other).exteriorDistance(Vec3(middle - above * world.frame.up)) < 0.1;
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
