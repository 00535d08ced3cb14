// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "segments.h"

#include <algorithm>
#include <cmath>

namespace scanworld {

namespace {

constexpr double kCell = 0.5;  // [m]

using Cell = std::array<std::int64_t, 3>;

Cell cell_of(const Vec3& p) {
  const auto index = [](double x) { return static_cast<std::int64_t>(std::floor(x / kCell)); };
  return {index(p.x()), index(p.y()), index(p.z())};
}

}  // namespace

std::optional<Stretch> side_by_side(const Segment& s, const Segment& t) {
  const double length = (s.to - s.from).norm();
  const Vec3 way = (s.to - s.from) / length;
  const double p = way.dot(t.from - s.from), q = way.dot(t.to - s.from);
  const double low = std::max(0.0, std::min(p, q)), high = std::min(length, std::max(p, q));
  if (!(high > low)) return std::nullopt;
  const auto gap = [&](double x) {
    return Vec3(t.from + (t.to - t.from) * ((x - p) / (q - p)) - (s.from + x * way));
  };
  return Stretch{high - low, std::max(gap(low).norm(), gap(high).norm()), gap((low + high) / 2)};
}

std::vector<std::pair<std::size_t, std::size_t>> near_pairs(const std::vector<Segment>& segments,
                                                            double distance) {
  std::vector<std::pair<Cell, std::size_t>> cells;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const Vec3 from = segments[s].from, way = segments[s].to - from;
    const int pieces = 1 + static_cast<int>(way.norm() / kCell);
    for (int k = 0; k < pieces; ++k) {
      Box3 box(Vec3(from + way * k / pieces));
      box = grown(box.extend(Vec3(from + way * (k + 1) / pieces)), distance);
      const Cell low = cell_of(box.min()), high = cell_of(box.max());
      for (std::int64_t x = low[0]; x <= high[0]; ++x)
        for (std::int64_t y = low[1]; y <= high[1]; ++y)
          for (std::int64_t z = low[2]; z <= high[2]; ++z) cells.push_back({{x, y, z}, s});
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t k = i + 1; k < cells.size() && cells[k].first == cells[i].first; ++k)
      pairs.push_back({cells[i].second, cells[k].second});
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace scanworld
