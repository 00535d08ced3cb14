// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "rectangles.h"
#include "world.h"

namespace scanworld {

// A convex polygon on the face of a surface and what is behind it, down to a depth.
struct Slab {
  // The points with normal * p <= offset.
  struct Side {
    Vec2 normal;  // outwards
    double offset = 0;
    double slack = 0;  // [m] it may be moved inwards by so much
  };

  std::size_t surface = 0;  // index into World::surfaces
  PlaneFrame frame;         // of the face: u x v points to its free side
  Rectangle bounds;         // nothing goes beyond
  std::vector<Side> sides;
  bool is_box = false;  // the sides are those of `bounds`
  double depth = 0;     // [m]

  Vec3 normal() const { return frame.u.cross(frame.v); }
  // The polygon, counter-clockwise; empty where nothing is left of it.
  std::vector<Vec2> corners() const;
  // A point as (u, v, depth), and back.
  Vec3 to_slab(const Vec3& p) const;
  Vec3 to_space(const Vec2& p, double depth) const;
  Box3 box() const;
  // Its front, its back and its sides as planar polygons, counter-clockwise seen from outside.
  std::vector<std::vector<Vec3>> outline() const;
};

// Slabs, with the boxes around them.
struct Slabs {
  std::vector<Slab> slabs;
  std::vector<Box3> boxes;

  void add(const std::vector<Slab>& more) {
    for (const Slab& slab : more) slabs.push_back(slab), boxes.push_back(slab.box());
  }
};

// The slab behind a rectangle; sides without slack.
Slab slab_of(std::size_t surface, const PlaneFrame& frame, const Rectangle& rectangle,
             double depth);

Collider collider_of(const Slab& slab, int surface_id);

}  // namespace scanworld
