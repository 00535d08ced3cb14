// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "types.h"

namespace scanworld {

// Twice the signed area of a ring: positive where it is counter-clockwise.
inline double doubled_area(const std::vector<Vec2>& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &p = ring[i], &q = ring[(i + 1) % ring.size()];
    sum += p.x() * q.y() - p.y() * q.x();
  }
  return sum;
}

// Whether a point is in a polygon, whose holes are loops as well: by the number of edges to its
// right (the even-odd rule).
inline bool is_inside(const std::vector<std::vector<Vec2>>& loops, const Vec2& p) {
  bool inside = false;
  for (const auto& loop : loops)
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
      const Vec2 &a = loop[i], &b = loop[j];
      if ((a.y() > p.y()) != (b.y() > p.y()) &&
          p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
        inside = !inside;
    }
  return inside;
}

}  // namespace scanworld
