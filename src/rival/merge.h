// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cluster.h"
#include "neighbors.h"
#include "scale.h"

namespace scanworld::rival {

struct MergeOptions {
  double max_rms = 1.35;  // [noise] of each part about the plane in common
};

// Unites neighbouring clusters that have one plane.
Clustering merge_clusters(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                          Clustering clustering, const MergeOptions& options = {});

}  // namespace scanworld::rival
