// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "../types.h"

namespace scanworld::rival {

// Whether two planes are at 45 degrees or more to each other.
inline bool is_across(const Plane& a, const Plane& b) {
  return std::abs(a.normal.dot(b.normal)) < 0.7;
}

// Whether a plane goes between two points.
inline bool is_between(const Plane& plane, const Vec3& a, const Vec3& b) {
  return plane.signed_distance(a) * plane.signed_distance(b) < 0;
}

}  // namespace scanworld::rival
