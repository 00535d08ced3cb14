// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "types.h"

namespace scanworld {

// What the points of a surface add up to, in whole numbers: their order does not matter.
struct PointSums {
  std::uint64_t points = 0;
  std::uint64_t square_um = 0;  // [um2] of the distances from the plane
  std::array<std::uint64_t, 3> color{};

  void add(const PointCloud& cloud, std::size_t point, const Plane& plane) {
    const double off = plane.signed_distance(cloud.points[point].cast<double>());
    const auto um = static_cast<std::uint64_t>(std::abs(off) * 1e6 + 0.5);
    ++points, square_um += um * um;
    if (cloud.colors.empty()) return;
    const Color& c = cloud.colors[point];
    color[0] += c.r, color[1] += c.g, color[2] += c.b;
  }
  PointSums& operator+=(const PointSums& o) {
    points += o.points, square_um += o.square_um;
    for (std::size_t k = 0; k < 3; ++k) color[k] += o.color[k];
    return *this;
  }

  // Gives a surface the number of its points, their rms and, where the scan has one, their colour.
  void describe(const PointCloud& cloud, FoundSurface& surface) const {
    surface.support.points = points;
    if (points == 0) return;
    const double n = static_cast<double>(points);
    surface.support.rms = std::sqrt(static_cast<double>(square_um) / n) * 1e-6;
    const auto mean = [&](std::size_t k) {
      return static_cast<std::uint8_t>(static_cast<double>(color[k]) / n + 0.5);
    };
    if (!cloud.colors.empty()) surface.color = Color{mean(0), mean(1), mean(2)};
  }
};

}  // namespace scanworld
