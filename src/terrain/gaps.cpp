// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "gaps.h"

#include <algorithm>
#include <cmath>

#include "../parallel.h"

namespace scanworld::terrain {

using surface::Raster;

Raster seen_through(const Heights& filled, const Level& level, const std::vector<SightLine>& lines,
                    double margin) {
  const Raster& raster = filled.known;
  constexpr int kLines = 5;  // fewer are strays
  std::vector<int> lines_through(raster.bits.size());
  for (const SightLine& line : lines) {
    const Spot to = level.spot(line.to), from = level.spot(line.from);
    const auto end = raster.find(to.at);
    if (!end || !raster.bits[*end] || to.height > filled.height[*end] - margin) continue;
    const double length = (from.at - to.at).norm();
    const int steps = static_cast<int>(length / raster.cell) + 1;
    for (int k = 0; k <= steps; ++k) {
      const double t = k / static_cast<double>(steps);
      const auto at = raster.find(to.at + t * (from.at - to.at));
      if (!at || !raster.bits[*at] ||
          to.height + t * (from.height - to.height) > filled.height[*at])
        break;
      ++lines_through[*at];
    }
  }
  Raster open = surface::empty_like(raster);
  for (std::size_t i = 0; i < open.bits.size(); ++i) open.bits[i] = lines_through[i] >= kLines;
  return open;
}

Heights filled(const Heights& heights, const Raster& wanted, int reach) {
  Heights all = heights;
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < wanted.bits.size(); ++i)
    if (wanted.bits[i] && !heights.known.bits[i]) missing.push_back(i);
  constexpr std::size_t kPart = 64;
  constexpr double kMaxStep = 0.3;  // [m] ground that rises by more in a gap is not one
  parallel_for(part_count(missing.size(), kPart), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, missing.size(), kPart);
    for (std::size_t n = begin; n < end; ++n) {
      const std::size_t i = missing[n];
      for (int r = 2; r <= 2 * reach; r *= 2) {
        const auto expected = heights.expected(wanted.column(i), wanted.row(i), r);
        if (!expected) continue;
        if (expected->spread <= kMaxStep) all.known.bits[i] = 1, all.height[i] = expected->height;
        break;
      }
    }
  });
  return all;
}

std::vector<std::vector<std::size_t>> pieces_of(const Raster& wanted) {
  std::vector<std::vector<std::size_t>> pieces;
  Raster left = wanted;
  for (std::size_t start = 0; start < left.bits.size(); ++start) {
    if (!left.bits[start]) continue;
    std::vector<std::size_t> piece = {start};
    left.bits[start] = 0;
    for (std::size_t n = 0; n < piece.size(); ++n) {
      const int x = wanted.column(piece[n]), y = wanted.row(piece[n]);
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
        if (left.is_set(x + dx, y + dy)) {
          piece.push_back(left.index(x + dx, y + dy));
          left.bits[piece.back()] = 0;
        }
    }
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

Raster large_pieces(const Raster& wanted, const Raster& counts, std::size_t least,
                    double least_share) {
  Raster large = surface::empty_like(wanted);
  for (const auto& piece : pieces_of(wanted)) {
    std::size_t count = 0;
    for (const std::size_t i : piece) count += counts.bits[i];
    if (count >= least &&
        static_cast<double>(count) >= least_share * static_cast<double>(piece.size()))
      for (const std::size_t i : piece) large.bits[i] = 1;
  }
  return large;
}

}  // namespace scanworld::terrain
