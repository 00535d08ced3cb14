// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "storeys.h"

#include <algorithm>
#include <cmath>

#include "level.h"

namespace scanworld {

std::vector<Storey> find_storeys(const World& world, const StoreyOptions& options) {
  struct Floor {
    int index;
    double height, area;
  };
  std::vector<Floor> floors;
  for (std::size_t i = 0; i < world.surfaces.size(); ++i)
    if (const Surface& s = world.surfaces[i]; s.kind == Kind::floor)
      floors.push_back(
          {static_cast<int>(i), world.frame.up.dot(centroid(world, s)), area(world, s)});
  std::stable_sort(floors.begin(), floors.end(),
                   [](const Floor& a, const Floor& b) { return a.area > b.area; });
  std::vector<Storey> storeys;
  const auto distance = [](const Floor& f, const Storey& s) {
    return std::abs(f.height - s.level);
  };
  for (const Floor& f : floors) {
    const bool is_apart = std::all_of(storeys.begin(), storeys.end(), [&](const Storey& s) {
      return distance(f, s) >= options.min_height;
    });
    if (is_apart && f.area >= options.min_area) storeys.push_back({.level = f.height});
  }
  if (storeys.empty()) return storeys;
  std::sort(storeys.begin(), storeys.end(),
            [](const Storey& a, const Storey& b) { return a.level < b.level; });
  for (const Floor& f : floors) {
    Storey& nearest = *std::min_element(
        storeys.begin(), storeys.end(),
        [&](const Storey& a, const Storey& b) { return distance(f, a) < distance(f, b); });
    nearest.area += f.area;
    nearest.floors.push_back(f.index);
  }
  for (Storey& s : storeys) std::sort(s.floors.begin(), s.floors.end());
  return storeys;
}

double main_level(const World& world) {
  if (const Surface* floor = main_floor(world)) return world.frame.up.dot(centroid(world, *floor));
  double lowest = world.vertices.empty() ? 0 : world.frame.up.dot(world.vertices[0]);
  for (const Vec3& v : world.vertices) lowest = std::min(lowest, world.frame.up.dot(v));
  return lowest;
}

}  // namespace scanworld
