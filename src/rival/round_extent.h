// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <span>

#include "../curve.h"
#include "grid.h"

namespace scanworld::rival {

// Where on a round surface some sites are.
struct RoundExtent {
  double low = 0, high = 0;    // [m] along the axis, from the shape's point
  Vec3 start = Vec3::UnitX();  // unit vector across the axis, to where they begin
  double sweep = 0;            // [rad] how far they go from there, to the left
  double cover = 0;            // share of that extent where there are sites

  // Of the surface that has sites [m2].
  double area(const RoundShape& shape) const {
    const double radius = shape.radius_at((low + high) / 2);
    return sweep * radius * (high - low) / std::cos(shape.half_angle) * cover;
  }
};

// The part of a round surface with some sites on it: without the outermost hundredth of them along
// the axis, and without the widest gap around it.
RoundExtent extent_of(const RoundShape& shape, const Grid& grid,
                      std::span<const std::uint32_t> sites);

// Half of the angle that they go over, at most pi; on a sphere the angle about their middle.
double half_sweep(const RoundShape& shape, const RoundExtent& extent, const Grid& grid,
                  std::span<const std::uint32_t> sites);

}  // namespace scanworld::rival
