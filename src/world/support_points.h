// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "../types.h"

namespace scanworld {

// Unit vectors spread evenly over the sphere, along a spiral (the lattice of Fibonacci).
inline std::vector<Vec3> even_directions(int count) {
  const double turn = M_PI * (3 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z);
    directions.emplace_back(r * std::cos(turn * i), r * std::sin(turn * i), z);
  }
  return directions;
}

// The point that lies farthest along each of some directions.
struct SupportPoints {
  std::vector<Vec3> points;
  std::vector<double> height;  // along the direction; empty where there is no point yet

  void add(const std::vector<Vec3>& directions, const Vec3& p) {
    if (height.empty())
      points.assign(directions.size(), p), height.assign(directions.size(), -1e300);
    for (std::size_t k = 0; k < directions.size(); ++k)
      if (const double h = directions[k].dot(p); h > height[k]) height[k] = h, points[k] = p;
  }
  void add(const SupportPoints& o) {
    if (height.empty()) return static_cast<void>(*this = o);
    for (std::size_t k = 0; k < o.height.size(); ++k)
      if (o.height[k] > height[k]) height[k] = o.height[k], points[k] = o.points[k];
  }
};

}  // namespace scanworld
