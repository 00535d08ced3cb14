// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "world.h"

namespace scanworld {

// Gives places that are equal to a grain [m] one index, also among the vertices that are there. New
// ones are put to the micrometre.
class VertexPool {
 public:
  explicit VertexPool(std::vector<Vec3>& vertices, double grain = 1e-6)
      : vertices_(vertices), per_metre_(std::round(1 / grain)) {
    for (std::size_t i = 0; i < vertices.size(); ++i)
      index_.try_emplace(cell_of(vertices[i], per_metre_), static_cast<int>(i));
  }

  Loop add(const std::vector<Vec3>& ring) {
    Loop loop;
    for (const Vec3& v : ring) {
      const int index = add(v);
      if (loop.empty() || (index != loop.back() && index != loop.front())) loop.push_back(index);
    }
    return loop;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;

  static Cell cell_of(const Vec3& v, double per_metre) {
    return {std::llround(v.x() * per_metre), std::llround(v.y() * per_metre),
            std::llround(v.z() * per_metre)};
  }

  int add(const Vec3& v) {
    const auto [found, is_new] =
        index_.try_emplace(cell_of(v, per_metre_), static_cast<int>(vertices_.size()));
    if (is_new) {
      const Cell um = cell_of(v, 1e6);
      vertices_.emplace_back(static_cast<double>(um[0]) / 1e6, static_cast<double>(um[1]) / 1e6,
                             static_cast<double>(um[2]) / 1e6);
    }
    return found->second;
  }

  std::vector<Vec3>& vertices_;
  const double per_metre_;
  std::map<Cell, int> index_;
};

}  // namespace scanworld
