// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "types.h"

namespace scanworld {

// A triangle, ready to be compared with many cubes.
class Facet {
 public:
  Plane plane;  // of the triangle, to its free side

  Facet(const std::array<Vec3, 3>& corners, const Plane& of)
      : plane(of), spread_(of.normal.cwiseAbs().sum()) {
    for (int axis = 0; axis < 3; ++axis) add_slab(corners, Vec3::Unit(axis));
    const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& from = corners[k];
      const Vec3 edge = corners[(k + 1) % 3] - from;
      for (int axis = 0; axis < 3; ++axis) add_slab(corners, edge.cross(Vec3::Unit(axis)));
      Vec3 inward = plane.normal.cross(edge);
      if (inward.dot(middle - from) < 0) inward = -inward;
      sides_[k] = {inward, -inward.dot(from)};
    }
  }

  // Whether some of a cube, with its middle and half its edge [m], is on the triangle or next to it
  // on its back: a cube that touches it with its face alone counts where it is behind, not where it
  // is before or beside it. They are apart where they are so along the normal of a face of one of
  // them, or along a direction square to an edge of each (Gottschalk et al. 1996).
  bool touches(const Vec3& center, double half) const {
    const double distance = plane.signed_distance(center);
    if (distance + half * spread_ < -kRounding || distance - half * spread_ > -kRounding)
      return false;
    for (std::size_t i = 0; i < slab_count_; ++i) {
      const Slab& slab = slabs_[i];
      if (std::abs(slab.axis.dot(center) - slab.middle) > slab.half + half * slab.spread)
        return false;
    }
    return true;
  }

  // Whether a point is straight before or behind the triangle.
  bool is_over(const Vec3& point) const {
    for (const Plane& side : sides_)
      if (side.signed_distance(point) < 0) return false;
    return true;
  }

 private:
  static constexpr double kRounding = 1e-7;  // [m] what is nearer to a face is on it

  // What the triangle takes of a direction.
  struct Slab {
    Vec3 axis;
    double middle, half;  // times the length of the axis; `half` is less by the rounding
    double spread;        // what a cube of half edge 1 takes to both sides
  };

  void add_slab(const std::array<Vec3, 3>& corners, const Vec3& axis) {
    const double spread = axis.cwiseAbs().sum();
    if (spread == 0) return;  // an edge along an axis
    const double a = axis.dot(corners[0]), b = axis.dot(corners[1]), c = axis.dot(corners[2]);
    const double low = std::min({a, b, c}), high = std::max({a, b, c});
    const double half = (high - low) / 2, rounding = kRounding * spread;
    // A direction that the triangle has no width in is its normal, which is dealt with apart.
    slabs_[slab_count_++] = {axis, (low + high) / 2,
                             half > 2 * rounding ? half - rounding : half + rounding, spread};
  }

  double spread_;  // of the normal, as that of a slab
  std::array<Slab, 12> slabs_;
  std::size_t slab_count_ = 0;
  std::array<Plane, 3> sides_;  // through an edge, square to the triangle; their normals have no
                                // length in particular and point inwards
};

}  // namespace scanworld
