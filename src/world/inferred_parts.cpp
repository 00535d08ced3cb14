// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "inferred_parts.h"

#include <algorithm>

#include "surface_rings.h"
#include "vertex_pool.h"

namespace scanworld {

namespace {

constexpr double kLeast = 1e-3;  // [m] narrower leftovers are none
constexpr double kGrain = 1e-5;  // [m] corners are moved by less where these are cut off

}  // namespace

std::vector<geos::Rings> inferred_rings(const Surface& surface, const PlaneFrame& frame) {
  std::vector<geos::Rings> parts;
  for (const InferredPart& part : surface.inferred) parts.push_back(flat_rings(frame, part));
  return parts;
}

double inferred_area(const World& world) {
  double sum = 0;
  for (const Surface& s : world.surfaces) {
    if (s.source == Source::inferred) sum += area(world, s);
    for (const geos::Rings& part : inferred_rings(s, frame_of(s.plane)))
      for (const auto& ring : part) sum += doubled_area(ring) / 2;
  }
  return sum;
}

bool cut_inferred(World& world) {
  std::vector<Surface> kept;
  bool is_less = false;
  int next = next_id(world);
  VertexPool pool(world.vertices, kGrain);
  for (const Surface& s : world.surfaces) {
    is_less |= s.source == Source::inferred || !s.inferred.empty();
    if (s.source == Source::inferred) continue;
    if (s.inferred.empty()) {
      kept.push_back(s);
      continue;
    }
    const PlaneFrame frame = rings_frame(world, s);
    bool is_first = true;
    for (const geos::Rings& left :
         geos::subtract(rings_of(world, s), inferred_rings(s, frame), kLeast)) {
      Surface piece = s;
      piece.inferred.clear(), piece.holes.clear();
      if (!is_first) piece.id = next++;
      piece.outer = pool.add(placed_ring(frame, left[0]));
      for (std::size_t k = 1; k < left.size(); ++k)
        if (Loop hole = pool.add(placed_ring(frame, left[k])); hole.size() > 2)
          piece.holes.push_back(std::move(hole));
      if (piece.outer.size() < 3) continue;
      is_first = false;
      kept.push_back(std::move(piece));
    }
  }
  world.surfaces = std::move(kept);
  return is_less;
}

}  // namespace scanworld
