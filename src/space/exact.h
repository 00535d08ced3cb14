// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Planes and points in whole numbers, so that it is told without rounding on which side of a plane
// the meeting point of three others lies.
//
// Lengths are in a unit that depends on the size of the place (`unit_for`): 2^-10 m as far as 128 m
// from its middle. Bits: a normal's components are at most n = 2^20, so it is at most sqrt(3) n
// long, a cross product 3 n^2 and a determinant of three 5.2 n^3. With offsets of at most D the
// numerators of a point, as a vector, are at most 9 D n^2, and its value in a fourth plane is at
// most (15.6 + 5.2) D n^3, below D 2^65. Planes within four times the radius of a place have
// offsets below 2^40; no plane has one above 2^62, which is some 2 kFarthest in the finest unit.
#pragma once

#include <cstdint>
#include <optional>

#include "../types.h"

namespace scanworld::space {

__extension__ typedef __int128 Int128;

// The points with a x + b y + c z + d = 0, in units. The largest of |a|, |b|, |c| is 2^20, so that
// equal planes have equal numbers, all of them with the other sign where they look the other way.
struct ExactPlane {
  std::int64_t a = 0, b = 0, c = 0;
  std::int64_t d = 0;
  Plane plane;  // the same, rounded to double [m]
};

// The point (x, y, z) / w, w > 0. The four have no common divisor, so that equal points have equal
// numbers.
struct ExactPoint {
  Int128 x = 0, y = 0, z = 0;
  std::int64_t w = 1;
  bool operator==(const ExactPoint&) const = default;
};

// [m] A power of two for a place of which nothing is farther from the zero point than `radius`: the
// least that offsets are told in 2^20ths of.
double unit_for(double radius);

// The plane in whole numbers that is nearest: turned by less than 1e-6 rad about its point nearest
// to zero, and moved there by a 2^21th of a unit at most. One that came from here comes back as it
// is. Throws Error where it is farther than can be told, beyond kFarthest.
ExactPlane exact_plane(const Plane& plane, double unit);

// Where three planes meet; nothing where that is no single point.
std::optional<ExactPoint> meet(const ExactPlane& p, const ExactPlane& q, const ExactPlane& r);

// 1 where the point lies before the plane, where its normal points, -1 behind, 0 on it.
int side_of(const ExactPlane& plane, const ExactPoint& point);

// [m] The point, rounded.
Vec3 place_of(const ExactPoint& point, double unit);

}  // namespace scanworld::space
