// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "flats.h"

#include <algorithm>

#include "../polygon.h"
#include "../world/surface_rings.h"

namespace scanworld::terrain {

std::vector<Flat> flats_of(const World& world, const Level& level, const surface::Raster& raster,
                           double least, double most) {
  std::vector<Flat> flats;
  for (std::size_t s = 0; s < world.surfaces.size(); ++s) {
    const Surface& surface = world.surfaces[s];
    const double rise = surface.plane.normal.dot(level.up);
    if (surface.curve || rise < least || rise > most) continue;
    Flat flat{.surface = s, .cells = {}, .plane = surface.plane};
    geos::Rings rings = {ring_of(world, surface.outer, level.frame)};
    for (const Loop& hole : surface.holes) rings.push_back(ring_of(world, hole, level.frame));
    Eigen::AlignedBox2d box;
    for (const Vec2& p : rings[0]) box.extend(p);
    const Vec2 low = (box.min() - raster.low) / raster.cell,
               high = (box.max() - raster.low) / raster.cell;
    for (int y = std::max(0, static_cast<int>(low.y())); y <= high.y() && y < raster.height; ++y)
      for (int x = std::max(0, static_cast<int>(low.x())); x <= high.x() && x < raster.width; ++x)
        if (is_inside(rings, raster.middle(x, y))) flat.cells.push_back(raster.index(x, y));
    if (!flat.cells.empty()) flats.push_back(std::move(flat));
  }
  std::stable_sort(flats.begin(), flats.end(),
                   [](const Flat& a, const Flat& b) { return a.cells.size() > b.cells.size(); });
  return flats;
}

}  // namespace scanworld::terrain
