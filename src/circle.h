// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "types.h"

namespace scanworld {

struct Circle {
  Vec2 center = Vec2::Zero();
  double radius = 0;

  double signed_distance(const Vec2& p) const { return (p - center).norm() - radius; }
};

// A point in the plane that counts as much.
struct WeightedPoint {
  Vec2 point;
  double weight = 1;
};

// The circle nearest to some points, which may be on a part of it only: by the algebraic distance
// with the norm of Taubin (1991), by Newton's iteration of Chernov (2010). Nothing where the points
// tell none.
inline std::optional<Circle> fit_circle(const std::vector<WeightedPoint>& points) {
  if (points.size() < 4) return std::nullopt;
  double n = 0;
  Vec2 mean = Vec2::Zero();
  for (const auto& [p, w] : points) n += w, mean += w * p;
  mean /= n;
  double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0, zz = 0;
  for (const auto& [p, w] : points) {
    const double x = p.x() - mean.x(), y = p.y() - mean.y(), z = x * x + y * y;
    xx += w * x * x / n, xy += w * x * y / n, yy += w * y * y / n;
    xz += w * x * z / n, yz += w * y * z / n, zz += w * z * z / n;
  }
  const double z = xx + yy, det = xx * yy - xy * xy, var = zz - z * z;
  const double a3 = 4 * z, a2 = -3 * z * z - zz, a1 = var * z + 4 * det * z - xz * xz - yz * yz,
               a0 = xz * (xz * yy - yz * xy) + yz * (yz * xx - xz * xy) - var * det;
  double root = 0, value = a0;
  for (int i = 0; i < 50; ++i) {
    const double next = root - value / (a1 + root * (2 * a2 + root * 3 * a3));
    const double there = a0 + next * (a1 + next * (a2 + next * a3));
    if (!(std::abs(there) < std::abs(value))) break;
    root = next, value = there;
  }
  const double below = 2 * (root * root - root * z + det);
  const Vec2 center = Vec2(xz * (yy - root) - yz * xy, yz * (xx - root) - xz * xy) / below;
  const double radius = std::sqrt(center.squaredNorm() + z);
  if (!std::isfinite(radius)) return std::nullopt;
  return Circle{center + mean, radius};
}

}  // namespace scanworld
