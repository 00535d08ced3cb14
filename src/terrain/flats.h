// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../surface/raster.h"
#include "../world/world.h"
#include "heights.h"

namespace scanworld::terrain {

// The plane through the origin that up is normal to, with heights over it.
struct Level {
  Vec3 up;
  PlaneFrame frame;

  explicit Level(const Vec3& axis) : up(axis), frame(frame_of({axis, 0})) {}
  Spot spot(const Vec3& p) const { return {frame.to_plane(p), up.dot(p)}; }
  Vec3 to_space(const Vec2& p, double height) const { return frame.to_space(p) + height * up; }
};

// A flat surface seen from above: the cells whose middles are in it.
struct Flat {
  std::size_t surface = 0;  // index
  std::vector<std::size_t> cells = {};
  Plane plane = {};

  double height_at(const Level& level, const Vec2& p) const {
    const Vec3 at = level.to_space(p, 0);
    return -plane.signed_distance(at) / plane.normal.dot(level.up);
  }
};

// The surfaces of a world whose normals have a component along up in a range, the largest first.
// Facets of curves are none.
std::vector<Flat> flats_of(const World& world, const Level& level, const surface::Raster& raster,
                           double least, double most);

}  // namespace scanworld::terrain
