// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "round_solids.h"

#include <algorithm>
#include <cmath>

#include "solids.h"

namespace scanworld {

namespace {

constexpr double kMaxRadius = 1;      // [m] of a column, pipe or cone
constexpr double kMaxSphere = 3;      // [m]
constexpr double kMinSweep = 2;       // [rad] of its side that was seen
constexpr double kUpright = 0.05;     // [rad] off upright, at most
constexpr double kBelowMiddle = 0.3;  // [radius] that a ball was seen below and above its middle
constexpr int kPrismSides = 16;       // of what is not upright
constexpr int kMostSides = 256;

}  // namespace

bool is_solid(const Curve& curve) {
  const double radius = curve.radius();
  if (curve.hollow || curve.sweep < kMinSweep) return false;
  if (curve.shape.type == CurveType::sphere)
    return radius <= kMaxSphere && curve.low < -kBelowMiddle * radius &&
           curve.high > kBelowMiddle * radius;
  return radius <= kMaxRadius;
}

int sides_of(double radius, double sagitta) {
  if (!(sagitta < radius)) return kFewestSides;
  const double half = std::acos(1 - sagitta / radius);
  return std::clamp(static_cast<int>(std::ceil(M_PI / half)), kFewestSides, kMostSides);
}

std::vector<Vec3> corners_of(const Curve& curve, int sides) {
  const RoundShape& shape = curve.shape;
  const Vec3 left = shape.axis.cross(curve.start);
  std::vector<Vec3> corners;
  const auto add_ring = [&](double height, double radius) {
    if (radius < 1e-4) return corners.push_back(shape.point + height * shape.axis);
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * M_PI * k / sides;
      corners.push_back(shape.point + height * shape.axis +
                        radius * (std::cos(angle) * curve.start + std::sin(angle) * left));
    }
  };
  if (shape.type == CurveType::sphere) {
    const int rings = std::max(sides / 2, 2);
    for (int k = 0; k <= rings; ++k) {
      const double angle = M_PI * k / rings;
      add_ring(-shape.radius * std::cos(angle), shape.radius * std::sin(angle));
    }
    return corners;
  }
  add_ring(curve.low, shape.radius_at(curve.low));
  add_ring(curve.high, shape.radius_at(curve.high));
  return corners;
}

Solid solid_of(const Curve& curve, const Vec3& up) {
  const RoundShape& shape = curve.shape;
  if (shape.type == CurveType::cylinder && std::abs(shape.axis.dot(up)) >= std::cos(kUpright))
    return Cylinder{shape.point + (curve.low + curve.high) / 2 * shape.axis, shape.radius,
                    curve.high - curve.low};
  return ConvexHull{corners_of(curve, kPrismSides)};
}

}  // namespace scanworld
