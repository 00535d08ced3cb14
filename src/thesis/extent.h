// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../types.h"

namespace scanworld::thesis {

// How large a scan is and how dense, told so that stray points do not matter.
struct Extent {
  Box3 bounds;  // of the points that have others around them; empty where no points do
  double cube_size =
      0;  // [m] edge of cubes of which the typical one holds the points asked for; 0 if none does
};

// The step against outliers that the thesis names as missing: one point far away would stretch its
// cubes. Space is divided into cells of powers of two of metres. Copies of a point count once.
// Cells with a single point do not count for the density, and sparse ones not for the bounds. So a
// point that is far from all others changes nothing, nor does the order of the points.
Extent find_extent(const PointCloud& cloud, double points_per_cube);

}  // namespace scanworld::thesis
