// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cluster.h"
#include "windows.h"

namespace scanworld::rival {

struct FlatnessOptions {
  WindowOptions windows;
  double smallest = 0.15, largest = 5;  // [m] edges of the squares that surfaces are cut into ...
  double min_voxels = 4;                // ... the smallest at least so many voxels
  std::size_t min_windows = 8;          // for a size to be believed
  double certain = 1.2;  // times the squared deviation of the smallest squares: less is chance
};

// How far the surfaces of a scan bend. Clusters that are whole surfaces are cut into squares of
// doubling size, and a plane is fitted to each: what the median of their mean squares grows by is
// bend. `limits` is a Flatness of which the limits are taken.
Flatness measure_flatness(const Grid& grid, const Clustering& clustering, const Flatness& limits,
                          const FlatnessOptions& options = {});

}  // namespace scanworld::rival
