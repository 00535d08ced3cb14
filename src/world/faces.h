// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "geos.h"
#include "world.h"

namespace scanworld {

// A surface with what is asked of it often.
struct Face {
  const Surface* surface = nullptr;
  PlaneFrame frame;   // u along most of its edges, those below first, or square to them
  geos::Rings rings;  // in that frame, vertex for vertex
  Box3 box;
  double area = 0;  // [m2]; 0 where it is no valid polygon

  const Vec3& normal() const { return surface->plane.normal; }
  // Whether a point is on it, or no farther off [m].
  bool is_near(const Vec3& p, double distance) const;
};

// The faces of all surfaces, in their order. The world must live as long as they.
std::vector<Face> faces_of(const World& world);

// The rings of a polygon in another frame, seen along that one's normal.
geos::Rings seen_in(const PlaneFrame& frame, const Face& face);

// What one edge of a face meets. The face is to the left of the way from a to b.
struct FaceEdge {
  Vec2 a, b;
  std::optional<std::size_t> before = {};  // the face whose back is beyond the edge: they make a
                                           // concave corner, and what is beyond is inside
  std::optional<std::size_t> beside = {};  // the one that goes on backwards, at a convex corner
  bool flat = false;                       // another face goes on in the same plane

  Vec2 along() const { return (b - a).normalized(); }
  Vec2 out() const { return {along().y(), -along().x()}; }
};

// Of all rings of face `i`; those are contacts that are no farther apart than `gap` [m].
std::vector<std::vector<FaceEdge>> edges_of(const std::vector<Face>& faces, std::size_t i,
                                            double gap);

}  // namespace scanworld
