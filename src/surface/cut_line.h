// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "../types.h"

namespace scanworld::surface {

struct Interval {
  double low = 0, high = 0;

  double length() const { return high - low; }
};

// The line that two planes have in common. Its points are told by t = direction . x, so that both
// planes tell them alike.
struct Line3 {
  Vec3 point = Vec3::Zero(), direction = Vec3::UnitX();

  Vec3 at(double t) const { return point + (t - direction.dot(point)) * direction; }
};

// Nothing where the planes are nearly parallel: the sine of their angle is less than `min_sine`.
inline std::optional<Line3> intersect(const Plane& a, const Plane& b, double min_sine) {
  const Vec3 cross = a.normal.cross(b.normal);
  const double sine = cross.norm();
  if (sine < min_sine) return std::nullopt;
  const Vec3 direction = cross / sine;
  // The point nearest to the origin.
  const Vec3 point =
      (a.offset * b.normal.cross(cross) - b.offset * a.normal.cross(cross)) / (sine * sine);
  return Line3{-point, direction};
}

// The point that three planes have in common; nothing where it is no clear one.
inline std::optional<Vec3> meet(const Plane& a, const Plane& b, const Plane& c) {
  constexpr double kMinDeterminant = 0.05;
  const Vec3 bc = b.normal.cross(c.normal);
  const double determinant = a.normal.dot(bc);
  if (std::abs(determinant) < kMinDeterminant) return std::nullopt;
  return Vec3(
      -(a.offset * bc + b.offset * c.normal.cross(a.normal) + c.offset * a.normal.cross(b.normal)) /
      determinant);
}

// A line along which a patch may end: that of another plane, or one that its own outline shows.
struct CutLine {
  int other = 0;  // the plane that cuts: of a patch, or one made for a free edge
  Line3 line;
  std::vector<Interval> seen;  // ascending: where the outline is, or both patches are near
  std::vector<Interval> sure;  // ascending: where both patches are
  Interval reach;              // where it may cut
  bool is_seam = false;        // between two patches
};

}  // namespace scanworld::surface
