// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../polygon.h"
#include "geos.h"
#include "world.h"

namespace scanworld {

// The frame of a surface's plane that rings_of() uses, with its origin near the first vertex.
inline PlaneFrame rings_frame(const World& world, const Surface& surface) {
  return frame_of(surface.plane, world.vertices[static_cast<std::size_t>(surface.outer[0])]);
}

// A loop in a frame of a plane. Its indices must be in range.
inline std::vector<Vec2> ring_of(const World& world, const Loop& loop, const PlaneFrame& frame) {
  std::vector<Vec2> points;
  for (int index : loop)
    points.push_back(frame.to_plane(world.vertices[static_cast<std::size_t>(index)]));
  return points;
}

// The loops of a surface in a frame of its plane, the outer one first, vertex for vertex. Their
// indices must be in range.
inline geos::Rings rings_of(const World& world, const Surface& surface, const PlaneFrame& frame) {
  geos::Rings rings = {ring_of(world, surface.outer, frame)};
  for (const Loop& hole : surface.holes) rings.push_back(ring_of(world, hole, frame));
  return rings;
}
inline geos::Rings rings_of(const World& world, const Surface& surface) {
  return rings_of(world, surface, rings_frame(world, surface));
}

// The rings of what has an outer one and holes, by places in a plane, in a frame of that.
template <typename Outline>
geos::Rings flat_rings(const PlaneFrame& frame, const Outline& outline) {
  const auto flat = [&](const std::vector<Vec3>& ring) {
    std::vector<Vec2> points;
    for (const Vec3& v : ring) points.push_back(frame.to_plane(v));
    return points;
  };
  geos::Rings rings = {flat(outline.outer)};
  for (const auto& hole : outline.holes) rings.push_back(flat(hole));
  return rings;
}

// A ring in space, to the micrometre as a world's vertices are.
inline std::vector<Vec3> placed_ring(const PlaneFrame& frame, const std::vector<Vec2>& ring) {
  std::vector<Vec3> placed;
  for (const Vec2& p : ring)
    placed.push_back((frame.to_space(p) * 1e6).array().round().matrix() / 1e6);
  return placed;
}

}  // namespace scanworld
