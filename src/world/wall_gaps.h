// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "../polygon.h"
#include "geos.h"
#include "world.h"

namespace scanworld {

struct WallGapOptions {
  double min_width = 0.3, min_height = 0.3;  // [m] of a gap
  double sill = 0.15;          // [m] what ends no higher over a floor or the wall's bottom is low
  double min_support = 0.5;    // share of each side of a gap that something is beside
  double min_piece = 0.3;      // [m] of a side of a gap within the wall
  double max_thickness = 0.6;  // [m] of a wall: such sides go no deeper
  double piece_depth = 0.04;   // [m] behind the face, where such sides are met
};

// Surfaces that look the same way in one upright plane.
struct WallFace {
  Plane plane;
  PlaneFrame frame;                        // upright
  std::vector<std::size_t> surfaces;       // indices, ascending
  std::vector<geos::Rings> rings;          // of each, in the frame
  std::vector<Eigen::AlignedBox2d> boxes;  // around each
  Eigen::AlignedBox2d box;
  double area = 0;  // [m2] of all

  bool holds(const Vec2& p) const {
    return std::any_of(rings.begin(), rings.end(),
                       [&](const geos::Rings& own) { return is_inside(own, p); });
  }
};

std::vector<WallFace> wall_faces_of(const World& world);

// An upright rectangle in the plane of a face that nothing of it is in.
struct WallGap {
  Eigen::AlignedBox2d clear;
  bool is_low = false;  // begins at a floor
  double measured = 0;  // share of its sides, but for the bottom of a low one, that are measured
};

// The largest ones, none within another. What stands within the wall's thickness, as the sides of a
// doorway behind its casing, ends them too.
std::vector<WallGap> gaps_of(const World& world, const WallFace& face,
                             const WallGapOptions& options = {});

}  // namespace scanworld
