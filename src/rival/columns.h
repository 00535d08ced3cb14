// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cluster.h"
#include "neighbors.h"
#include "scale.h"

namespace scanworld::rival {

struct ColumnOptions {
  double max_slope = 0.1;  // [rad] off upright of the facets of a column
  double max_radius = 1;   // [m] a wider curve is a wall
  double max_noise = 1.5;  // [noise] rms of the points off the cylinder
};

// Drops the facets of upright round columns: neighbouring narrow clusters whose points lie better
// on one cylinder than on the facets' own planes. Those of an octagonal column do not.
Clustering drop_columns(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                        Clustering clustering, const ColumnOptions& options = {});

}  // namespace scanworld::rival
