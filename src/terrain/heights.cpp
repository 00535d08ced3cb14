// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "heights.h"

#include <algorithm>
#include <cmath>

#include "../parallel.h"

namespace scanworld::terrain {

namespace {

// Calls visit(x, y) for the cells no more than `reach` from one along both axes.
template <typename Visit>
void visit_around(const surface::Raster& raster, int x, int y, int reach, const Visit& visit) {
  for (int v = std::max(0, y - reach); v <= std::min(raster.height - 1, y + reach); ++v)
    for (int u = std::max(0, x - reach); u <= std::min(raster.width - 1, x + reach); ++u)
      visit(u, v);
}

}  // namespace

template <typename Takes>
std::optional<Heights::Expected> Heights::fitted(int x, int y, int reach,
                                                 const Takes& takes) const {
  double nearest = 1e300;
  // Sums for a fit of a + b u + c v. A little of b^2 + c^2 is added to what is least, so that few
  // cells give a level plane.
  Eigen::Matrix3d sums = Eigen::Vector3d(0, 1, 1).asDiagonal();
  Vec3 right = Vec3::Zero();
  double base = 0, low = 1e300, high = -1e300;
  visit_around(known, x, y, reach, [&](int u, int v) {
    const std::size_t i = known.index(u, v);
    if (!known.bits[i] || !takes(i)) return;
    const double distance = std::hypot(u - x, v - y);
    if (nearest > 1e299) base = height[i];
    nearest = std::min(nearest, distance);
    low = std::min(low, height[i]), high = std::max(high, height[i]);
    const double weight = 1 / (1 + distance * distance);
    const Vec3 row(1, u - x, v - y);
    sums += weight * row * row.transpose();
    right += weight * (height[i] - base) * row;
  });
  if (nearest > 1e299) return std::nullopt;
  return Expected{base + sums.ldlt().solve(right)[0], nearest, high - low};
}

std::optional<Heights::Expected> Heights::expected(int x, int y, int reach) const {
  return fitted(x, y, reach, [](std::size_t) { return true; });
}

Heights Heights::smoothed(int reach, double step) const {
  Heights smooth = *this;
  parallel_for(static_cast<std::size_t>(known.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < known.width; ++x)
      if (const std::size_t i = known.index(x, y); known.bits[i])
        smooth.height[i] = fitted(x, y, reach, [&](std::size_t k) {
                             return std::abs(height[k] - height[i]) <= step;
                           })->height;
  });
  return smooth;
}

SpotColumns::SpotColumns(const std::vector<Spot>& spots, const HeightOptions& options) {
  Eigen::AlignedBox2d box;
  for (const Spot& s : spots) box.extend(s.at);
  if (box.isEmpty()) box.extend(Vec2(0, 0));
  const double margin = 2 * options.reach;
  const double area = (box.sizes().array() + 2 * margin).prod();
  const double cell = std::max(options.cell, std::sqrt(area / std::max(1.0, options.max_cells)));
  none_.known = surface::raster_around(box, margin, cell);
  none_.height.assign(none_.known.bits.size(), 0);
  first_.assign(none_.known.bits.size() + 1, 0);
  std::vector<std::uint32_t> cell_of;
  for (const Spot& s : spots) {
    cell_of.push_back(static_cast<std::uint32_t>(*none_.known.find(s.at)));
    ++first_[cell_of.back() + 1];
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  height_.resize(spots.size());
  std::vector<std::uint32_t> next = first_;
  for (std::size_t i = 0; i < spots.size(); ++i) height_[next[cell_of[i]]++] = spots[i].height;
  for (std::size_t i = 0; i + 1 < first_.size(); ++i)
    std::sort(height_.begin() + first_[i], height_.begin() + first_[i + 1]);
}

std::optional<double> SpotColumns::near(std::size_t cell, double height, double distance) const {
  const auto begin = height_.begin() + first_[cell], end = height_.begin() + first_[cell + 1];
  double sum = 0;
  int count = 0;
  for (auto at = std::lower_bound(begin, end, height - distance);
       at != end && *at <= height + distance; ++at)
    sum += *at, ++count;
  if (count == 0) return std::nullopt;
  return sum / count;
}

Heights grow_ground(const SpotColumns& spots, Heights heights, const HeightOptions& options) {
  surface::Raster& known = heights.known;
  const int farthest = std::max(1, static_cast<int>(std::lround(options.reach / known.cell)));
  std::vector<std::uint32_t> seen_in(known.bits.size());  // the last round that looked at a cell
  std::uint32_t round = 0;
  for (int reach = 1; reach <= farthest; reach *= 2) {
    std::vector<std::size_t> fresh;
    for (std::size_t i = 0; i < known.bits.size(); ++i)
      if (known.bits[i]) fresh.push_back(i);
    while (!fresh.empty()) {
      ++round;
      std::vector<std::size_t> candidates;
      for (const std::size_t i : fresh)
        visit_around(known, known.column(i), known.row(i), reach, [&](int x, int y) {
          const std::size_t k = known.index(x, y);
          if (known.bits[k] || seen_in[k] == round || spots.is_empty(k)) return;
          seen_in[k] = round;
          candidates.push_back(k);
        });
      std::vector<std::optional<double>> found(candidates.size());
      constexpr std::size_t kPart = 64;
      parallel_for(part_count(candidates.size(), kPart), [&](std::size_t part) {
        const auto [begin, end] = part_of(part, candidates.size(), kPart);
        for (std::size_t n = begin; n < end; ++n) {
          const std::size_t k = candidates[n];
          // A plane wants more than what is next.
          const auto expected = heights.expected(known.column(k), known.row(k), reach + 2);
          if (expected)
            found[n] =
                spots.near(k, expected->height,
                           options.tolerance + options.turn * expected->distance * known.cell);
        }
      });
      fresh.clear();
      for (std::size_t n = 0; n < candidates.size(); ++n)
        if (found[n]) {
          known.bits[candidates[n]] = 1, heights.height[candidates[n]] = *found[n];
          fresh.push_back(candidates[n]);
        }
    }
  }
  return heights;
}

}  // namespace scanworld::terrain
