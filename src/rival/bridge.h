// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cluster.h"
#include "grid.h"
#include "scale.h"

namespace scanworld::rival {

struct BridgeOptions {
  int max_gap = 8;          // [voxels] at most 8
  int reach = 3;            // [voxels] in which a crossing cluster must be there
  double max_rms = 1.35;    // [noise] of each part about the plane in common
  double open_share = 0.5;  // of the shortest links that nothing may cross, at least
};

// Unites coplanar clusters across a gap that no other cluster's plane goes through: a wall that is
// sparse or hidden in places is one wall.
Clustering bridge_clusters(const Grid& grid, const Scale& scale, Clustering clustering,
                           const BridgeOptions& options = {});

}  // namespace scanworld::rival
