// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cluster.h"
#include "neighbors.h"

namespace scanworld::rival {

struct SplitOptions {
  int reach = 2;           // [voxels] in which a crossing cluster must be there
  double min_points = 60;  // parts of fewer points are left to whoever competes for them
};

// Divides clusters into connected parts. Sites are connected where they are near each other and no
// plane of another cluster that is there goes between them: coplanar walls of two rooms are two.
Clustering split_clusters(const Grid& grid, const Neighbors& neighbors, Clustering clustering,
                          const SplitOptions& options = {});

}  // namespace scanworld::rival
