// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "../types.h"

namespace scanworld {

struct Ellipsoid {
  Vec3 center = Vec3::Zero();
  Mat3 to_ball = Mat3::Identity();    // what makes of it the unit ball, about the centre
  Vec3 radii = Vec3::Constant(1);     // [m] from the shortest to the longest
  Mat3 half_axes = Mat3::Identity();  // [m] as columns, in the order of the radii

  // How far a point is outside, to first order; less than 0 inside.
  double signed_distance(const Vec3& p) const {
    const Vec3 q = to_ball * (p - center);
    const double length = q.norm(), slope = (to_ball.transpose() * q).norm();
    return slope > 0 ? length * (length - 1) / slope : -radii[0];
  }
};

// The ellipsoid nearest to some points, which may be on a part of it only: by the algebraic
// distance over its slope. Nothing where they lie on none. `stiffness` [m]: the more, the more of a
// ball it is where the points leave that open; of the order of their noise. It is too small for
// points on a small part, unless `is_final`: then it heeds as well how the slope changes, which
// takes longer and needs points that lie on one ellipsoid.
std::optional<Ellipsoid> fit_ellipsoid(std::span<const Vec3> points, double stiffness,
                                       bool is_final = true);

// How well points tell where an ellipsoid is, that has so much noise [m]: the standard deviation of
// its surface where that is known least.
double uncertainty_of(const Ellipsoid& ellipsoid, std::span<const Vec3> points, double noise);

// The corners of a hull that follows an ellipsoid, partly in and partly out of it; at most so many.
std::vector<Vec3> corners_of(const Ellipsoid& ellipsoid, int max_vertices);

}  // namespace scanworld
