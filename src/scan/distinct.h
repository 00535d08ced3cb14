// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "../types.h"

namespace scanworld {

// A scan without the points that are at the very place of another. Files that were merged with
// themselves, or scans that overlap, hold places twice; that is no evidence of anything.
struct DistinctPoints {
  std::optional<PointCloud> cloud;   // nothing where all points are at places of their own
  std::vector<std::uint32_t> place;  // for each point of the scan its number in `cloud`

  const PointCloud& of(const PointCloud& scan) const { return cloud ? *cloud : scan; }

  // What is known of each place, for each point of the scan.
  std::vector<std::int32_t> expand(std::vector<std::int32_t> labels) const;
};

// The duplicates.
inline std::size_t count_of(const DistinctPoints& points) {
  return points.cloud ? points.place.size() - points.cloud->points.size() : 0;
}

// Of points at one place that are unlike, the one with the least normal, then colour, is kept,
// whatever their order; then one whose viewpoint is known, and the one whose is least.
DistinctPoints find_distinct(const PointCloud& scan);

}  // namespace scanworld
