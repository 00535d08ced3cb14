// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "round_extent.h"

#include <algorithm>
#include <cmath>

#include "../quantile.h"

namespace scanworld::rival {

namespace {

constexpr double kLeastGap = 0.35;  // [rad] of what goes all around, at most
constexpr double kCell = 1.5;       // [voxel] in which there should be a site
constexpr double kStray = 0.01;     // share of the sites at either end that may be strays
constexpr double kNarrow = 0.002;   // and at the narrow end of a cone, that has few

// The widest run of empty columns of a ring, and the column after it.
std::pair<int, int> widest_gap(const std::vector<char>& column) {
  const int bins = static_cast<int>(column.size());
  int widest = 0, end = 0, run = 0;
  for (int b = 0; b < 2 * bins; ++b) {
    run = column[static_cast<std::size_t>(b % bins)] ? 0 : run + 1;
    if (run > widest && run <= bins) widest = run, end = (b + 1) % bins;
  }
  return {widest, end};
}

}  // namespace

RoundExtent extent_of(const RoundShape& shape, const Grid& grid,
                      std::span<const std::uint32_t> sites) {
  const Vec3 zero = frame_of({shape.axis, 0}).u, left = shape.axis.cross(zero);
  std::vector<double> low, high, height, angle;
  for (std::uint32_t i : sites) {
    const Site& s = grid.sites[i];
    const Vec3 way = s.position() - shape.point;
    const double h = way.dot(shape.axis), half = std::sqrt(3 * s.variance(shape.axis));
    height.push_back(h), low.push_back(h - half), high.push_back(h + half);
    angle.push_back(std::atan2(way.dot(left), way.dot(zero)) + M_PI);
  }
  RoundExtent e;
  const bool is_cone = shape.type == CurveType::cone;
  e.low = quantile(std::move(low), is_cone ? kNarrow : kStray);
  e.high = quantile(std::move(high), 1 - kStray);
  const double cell = kCell * grid.voxel, radius = shape.radius_at((e.low + e.high) / 2);
  const int bins = std::clamp(static_cast<int>(2 * M_PI * radius / cell), 8, 256);
  const int rows = std::max(1, static_cast<int>((e.high - e.low) / cell));
  std::vector<char> hit(static_cast<std::size_t>(bins * rows)),
      column(static_cast<std::size_t>(bins));
  for (std::size_t k = 0; k < angle.size(); ++k) {
    const int b = std::min(bins - 1, static_cast<int>(angle[k] / (2 * M_PI) * bins));
    const int r = std::clamp(static_cast<int>((height[k] - e.low) / cell), 0, rows - 1);
    hit[static_cast<std::size_t>(r * bins + b)] = 1, column[static_cast<std::size_t>(b)] = 1;
  }
  const auto [widest, end] = widest_gap(column);
  const double bin = 2 * M_PI / bins;
  const bool is_whole = widest * bin <= kLeastGap;
  const double from = is_whole ? 0 : end * bin - M_PI;
  e.sweep = is_whole ? 2 * M_PI : 2 * M_PI - widest * bin;
  e.start = std::cos(from) * zero + std::sin(from) * left;
  e.cover = static_cast<double>(std::count(hit.begin(), hit.end(), 1)) / (rows * e.sweep / bin);
  return e;
}

double half_sweep(const RoundShape& shape, const RoundExtent& extent, const Grid& grid,
                  std::span<const std::uint32_t> sites) {
  if (shape.type != CurveType::sphere) return extent.sweep / 2;
  Vec3 middle = Vec3::Zero();
  for (std::uint32_t i : sites) middle += shape.normal_at(grid.sites[i].position());
  middle.normalize();
  std::vector<double> cosines;
  for (std::uint32_t i : sites)
    cosines.push_back(middle.dot(shape.normal_at(grid.sites[i].position())));
  return std::acos(std::clamp(quantile(std::move(cosines), 0.05), -1.0, 1.0));
}

}  // namespace scanworld::rival
