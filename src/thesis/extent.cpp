// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "extent.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "../parallel.h"
#include "cells.h"

namespace scanworld::thesis {

namespace {

constexpr std::size_t kSample = 1 << 16;  // points that tell the rough size
constexpr int kLevels = 16;         // sizes of cells that are looked at, each twice the one before
constexpr double kManyLone = 0.30;  // share of cells with a single point that is too large
constexpr double kSparse =
    1.0 / 32;  // of the dense count: cells with less are not counted as part of the place

// The bits of a number of 21 bits, spread to every third.
std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

// Cells in Z-order: those of a coarser grid are runs of those of a finer one (Morton, 1966).
std::uint64_t morton(const Cell& c) {
  const auto biased = [](std::int32_t index) {
    return static_cast<std::uint64_t>(index + Cell::kLimit);
  };
  return spread_bits(biased(c.i)) << 2 | spread_bits(biased(c.j)) << 1 | spread_bits(biased(c.k));
}

std::int32_t gather_bits(std::uint64_t x) {
  x &= 0x1249249249249249;
  x = (x ^ x >> 2) & 0x10c30c30c30c30c3;
  x = (x ^ x >> 4) & 0x100f00f00f00f00f;
  x = (x ^ x >> 8) & 0x1f0000ff0000ff;
  x = (x ^ x >> 16) & 0x1f00000000ffff;
  x = (x ^ x >> 32) & 0x1fffff;
  return static_cast<std::int32_t>(x) - Cell::kLimit;
}

Vec3 corner_of(std::uint64_t key, double size) {
  return Vec3(gather_bits(key >> 2), gather_bits(key >> 1), gather_bits(key)) * size;
}

// Every so many-th point, chosen by its coordinates, where there are many.
std::vector<Vec3f> sample(const std::vector<Vec3f>& points) {
  int shift = 0;
  while (points.size() >> shift > kSample) ++shift;
  std::vector<Vec3f> chosen;
  for (const Vec3f& p : points) {
    std::uint32_t hash = 0;
    for (float v : p) hash = (hash ^ std::bit_cast<std::uint32_t>(v)) * 0x9e3779b1 ^ hash >> 15;
    if (shift == 0 || hash >> (32 - shift) == 0) chosen.push_back(p);
  }
  return chosen;
}

// The largest extent of the middle half of the points.
double middle_half(const std::vector<Vec3f>& points) {
  double largest = 0;
  std::vector<float> values(points.size());
  for (int axis = 0; axis < 3 && !points.empty(); ++axis) {
    std::transform(points.begin(), points.end(), values.begin(),
                   [&](const Vec3f& p) { return p[axis]; });
    const auto rank = [&](std::size_t quarters) {
      const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * quarters / 4);
      std::nth_element(values.begin(), at, values.end());
      return static_cast<double>(*at);
    };
    largest = std::max(largest, rank(3) - rank(1));
  }
  return largest;
}

// Calls visit(first, count) for each cell of the level that holds points: where its points begin.
template <typename Visit>
void each_cell(const std::vector<std::uint64_t>& keys, int level, Visit visit) {
  for (std::size_t first = 0, last = 0; first < keys.size(); first = last) {
    while (last < keys.size() && keys[last] >> 3 * level == keys[first] >> 3 * level) ++last;
    visit(first, last - first);
  }
}

// How the points lie in the cells of a level.
struct Filling {
  double dense =
      0;  // a quarter of the cells with more than one point hold more than this; 0 without such
  double lone = 1;  // share of the cells that hold a single point
};

Filling filling_of(const std::vector<std::uint64_t>& keys, int level) {
  std::vector<std::size_t> counts;
  std::size_t lone = 0;
  each_cell(keys, level, [&](std::size_t, std::size_t count) {
    if (count > 1)
      counts.push_back(count);
    else
      ++lone;
  });
  if (counts.empty()) return {};
  const double share = static_cast<double>(lone) / static_cast<double>(lone + counts.size());
  const auto at = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() * 3 / 4);
  std::nth_element(counts.begin(), at, counts.end());
  return {static_cast<double>(*at), share};
}

// The edge of cubes that typically hold the points asked for, between those of two levels; larger
// by steps of a quarter octave, an octave at most, where too many of them would hold a single
// point. (A scan from one place is dense around it and thin far away.) 0 where no cell of any level
// holds two points.
double find_cube_size(const std::vector<std::uint64_t>& keys, double finest,
                      double points_per_cube) {
  // From coarse to fine, so that many points in one place do not matter.
  int level = kLevels;
  std::vector<Filling> fillings(kLevels + 1);
  fillings[kLevels] = filling_of(keys, kLevels);
  for (; level > 1; --level) {
    const std::size_t below = static_cast<std::size_t>(level) - 1;
    fillings[below] = filling_of(keys, level - 1);
    if (fillings[below].dense < points_per_cube) break;
  }
  const Filling &coarse = fillings[static_cast<std::size_t>(level)],
                &fine = fillings[static_cast<std::size_t>(level) - 1];
  if (coarse.dense == 0) return 0;
  // Between two levels the count grows by a power of the size.
  const double over =
      fine.dense > 0 && fine.dense < coarse.dense
          ? std::log2(coarse.dense / points_per_cube) / std::log2(coarse.dense / fine.dense)
          : 0;
  const double octave = level - std::clamp(over, 0.0, 1.0);  // the size is finest times two to this
  const auto lone_at = [&](double at) {
    const std::size_t low = static_cast<std::size_t>(at),
                      high = std::min<std::size_t>(low + 1, kLevels);
    return fillings[low].lone + (at - std::floor(at)) * (fillings[high].lone - fillings[low].lone);
  };
  double best = octave;
  for (double at = octave; at <= std::min(octave + 1, static_cast<double>(kLevels)); at += 0.25) {
    if (lone_at(at) < lone_at(best)) best = at;
    if (lone_at(best) <= kManyLone) break;
  }
  return finest * std::exp2(best);
}

// The box of the points that lie in the box of the cells of a level, without the sparse ones.
Box3 bounds_of(const std::vector<Vec3f>& points, const std::vector<std::uint64_t>& keys, int level,
               double finest) {
  Box3 outer;
  const double enough = std::max(2.0, kSparse * filling_of(keys, level).dense);
  const double size = std::ldexp(finest, level);
  each_cell(keys, level, [&](std::size_t first, std::size_t count) {
    if (static_cast<double>(count) < enough) return;
    const Vec3 corner = corner_of(keys[first] >> 3 * level << 3 * level, finest);
    outer.extend(corner).extend(corner + Vec3::Constant(size));
  });
  std::vector<Box3> boxes(part_count(points.size(), kPointsPerPart));
  parallel_for(boxes.size(), [&](std::size_t i) {
    const Part part = part_of(i, points.size(), kPointsPerPart);
    for (std::size_t k = part.begin; k < part.end; ++k)
      if (const Vec3 p = points[k].cast<double>(); outer.contains(p)) boxes[i].extend(p);
  });
  Box3 bounds;
  for (const Box3& box : boxes)
    if (!box.isEmpty()) bounds.extend(box);
  return bounds;
}

}  // namespace

Extent find_extent(const PointCloud& cloud, double points_per_cube) {
  // The finest cells are so fine that none needs to be finer, and so that they reach far beyond the
  // place.
  const double finest =
      std::ldexp(1.0, std::ilogb(std::max(middle_half(sample(cloud.points)), 1e-6)) - 12);
  std::vector<std::uint64_t> keys;
  keys.reserve(cloud.points.size());
  for (const Vec3f& p : cloud.points)
    if (const auto cell = cell_of(p.cast<double>(), Vec3::Zero(), finest))
      keys.push_back(morton(*cell));
  radix_sort(keys, [](std::uint64_t key) { return key; });

  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());  // copies tell nothing

  const double cube_size = find_cube_size(keys, finest, points_per_cube);
  if (cube_size == 0) return {};
  const int level =
      std::clamp(static_cast<int>(std::lround(std::log2(cube_size / finest))) + 2, 0, kLevels);
  return {bounds_of(cloud.points, keys, level, finest), cube_size};
}

}  // namespace scanworld::thesis
