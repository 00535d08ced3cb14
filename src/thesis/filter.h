// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../types.h"

namespace scanworld::thesis {

struct FilterOptions {
  int points_per_dimension =
      0;  // cubes along the longest extent; 0 = by density, as the next two say
  double points_per_cube = 8;  // points that a cube in the denser parts of the scan shall hold
  double min_size = 0.05;      // [m] cubes are not smaller: below that they tell noise, not walls
  double depth_step =
      0;  // [1/m] a depth camera measures in steps of this times the depth squared; where it
          // is not 0, cubes are no smaller than two steps at the far end of the scan
  int min_points = 1;  // cubes with no more different points are outliers
};

struct FilteredPoints {
  double delta = 0;          // [m] edge of the cubes, the length that the other stages measure in
  std::vector<Vec3> points;  // the median of each cube that was kept
  std::vector<int> from_input;  // for each point of the cloud: the point that stands for it, or -1
};

inline std::size_t count_of(const FilteredPoints& filtered) { return filtered.points.size(); }

// Divides space into cubes; those with more than `min_points` points are replaced by the
// component-wise median of their points, the others are dropped. Based on: V. Petrik, Spatial
// Models in Mobile Robotics, 2012, Algorithm 4. Different from it: the cubes are half-open, so that
// a point on a face belongs to one of them; the last ones are included; their size can follow the
// density of the points; and the extent is that without outliers.
FilteredPoints filter_points(const PointCloud& cloud, const FilterOptions& options = {});

}  // namespace scanworld::thesis
