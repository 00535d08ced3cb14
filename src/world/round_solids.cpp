// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "round_solids.h"

#include <cmath>

#include "solids.h"

namespace scanworld {

namespace {

constexpr double kMaxRadius = 1;   // [m] of a column or pipe
constexpr double kMinSweep = 2;    // [rad] of its side that was seen
constexpr double kUpright = 0.05;  // [rad] off upright, at most
constexpr int kPrismSides = 16;    // of what is not upright

}  // namespace

bool is_solid(const Curve& curve) {
  return curve.shape.type == CurveType::cylinder && !curve.hollow &&
         curve.shape.radius <= kMaxRadius && curve.sweep >= kMinSweep;
}

Solid solid_of(const Curve& curve, const Vec3& up) {
  const RoundShape& shape = curve.shape;
  const Cylinder cylinder{shape.point + (curve.low + curve.high) / 2 * shape.axis, shape.radius,
                          curve.high - curve.low};
  if (std::abs(shape.axis.dot(up)) >= std::cos(kUpright)) return cylinder;
  return ConvexHull{mesh_of(cylinder, shape.axis, kPrismSides).vertices};
}

}  // namespace scanworld
