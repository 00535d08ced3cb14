// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "filter.h"

#include <algorithm>
#include <cmath>

#include "../parallel.h"
#include "cells.h"
#include "extent.h"

namespace scanworld::thesis {

namespace {

constexpr std::uint64_t kNoCell = UINT64_MAX;

struct Entry {
  std::uint64_t cell;
  std::uint32_t point;
};

// Orders cells by i, then j, then k.
std::uint64_t key_of(const Cell& c) {
  const auto biased = [](std::int32_t index) {
    return static_cast<std::uint64_t>(index + Cell::kLimit);
  };
  return biased(c.i) << 42 | biased(c.j) << 21 | biased(c.k);
}

// The points by cube, in the order of the cubes.
std::vector<Entry> sort_into_cubes(const std::vector<Vec3f>& points, const Vec3& corner,
                                   double delta) {
  std::vector<Entry> entries(points.size());
  parallel_for(part_count(points.size(), kPointsPerPart), [&](std::size_t i) {
    const Part part = part_of(i, points.size(), kPointsPerPart);
    for (std::size_t k = part.begin; k < part.end; ++k) {
      const auto cell = cell_of(points[k].cast<double>(), corner, delta);
      entries[k] = {cell ? key_of(*cell) : kNoCell, static_cast<std::uint32_t>(k)};
    }
  });
  std::erase_if(entries, [](const Entry& e) { return e.cell == kNoCell; });
  radix_sort(entries, [](const Entry& e) { return e.cell; });
  return entries;
}

Vec3 median(const std::vector<Vec3f>& points, const Entry* first, const Entry* last) {
  std::vector<float> values(static_cast<std::size_t>(last - first));
  Vec3 result;
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(first, last, values.begin(),
                   [&](const Entry& e) { return points[e.point][axis]; });
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    result[axis] = *middle;
  }
  return result;
}

// How many different points there are, counted up to `enough`: copies of one are no evidence.
std::size_t count_different(const std::vector<Vec3f>& points, const Entry* first, const Entry* last,
                            std::size_t enough) {
  std::vector<Vec3f> different;
  for (const Entry* e = first; e != last && different.size() < enough; ++e)
    if (std::find(different.begin(), different.end(), points[e->point]) == different.end())
      different.push_back(points[e->point]);
  return different.size();
}

// How far the scan goes from the scanner: 95 % of the points are nearer. 0 where the scanner is not
// known.
double far_end(const PointCloud& cloud) {
  if (cloud.viewpoints.size() != 1) return 0;
  std::vector<float> distances;
  const Vec3f from = cloud.viewpoints[0].cast<float>();
  for (const Vec3f& p : cloud.points) distances.push_back((p - from).norm());
  const auto at = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() * 95 / 100);
  std::nth_element(distances.begin(), at, distances.end());
  return *at;
}

// The edge of the cubes where the density of the points decides.
double size_by_density(const PointCloud& cloud, const Extent& extent,
                       const FilterOptions& options) {
  const double far = options.depth_step > 0 ? far_end(cloud) : 0;
  return std::max({extent.cube_size, options.min_size, 2 * options.depth_step * far * far});
}

}  // namespace

FilteredPoints filter_points(const PointCloud& cloud, const FilterOptions& options) {
  const Extent extent = find_extent(cloud, options.points_per_cube);
  FilteredPoints result{.from_input = std::vector<int>(cloud.points.size(), -1)};
  if (extent.bounds.isEmpty()) return result;
  result.delta = options.points_per_dimension > 0
                     ? extent.bounds.sizes().maxCoeff() / options.points_per_dimension
                     : size_by_density(cloud, extent, options);
  if (!(result.delta > 0)) return result;

  const auto min_points = static_cast<std::size_t>(options.min_points);
  const std::vector<Entry> entries =
      sort_into_cubes(cloud.points, extent.bounds.min(), result.delta);
  for (std::size_t first = 0, last = 0; first < entries.size(); first = last) {
    while (last < entries.size() && entries[last].cell == entries[first].cell) ++last;
    if (count_different(cloud.points, &entries[first], &entries[last - 1] + 1, min_points + 1) <=
        min_points)
      continue;
    for (std::size_t k = first; k < last; ++k)
      result.from_input[entries[k].point] = static_cast<int>(result.points.size());
    result.points.push_back(median(cloud.points, &entries[first], &entries[last - 1] + 1));
  }
  return result;
}

}  // namespace scanworld::thesis
