// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cluster.h"
#include "neighbors.h"
#include "scale.h"

namespace scanworld::rival {

struct MergeOptions {
  double max_rms = 1.35;   // [noise and bend] of each part about the plane in common
  double min_step = 0.01;  // [m] parts that meet with a higher step, if it is also ...
  double step_errors = 3;  // ... more than so many standard errors, are two surfaces
};

// Unites neighbouring clusters that have one plane.
Clustering merge_clusters(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                          Clustering clustering, const MergeOptions& options = {});

}  // namespace scanworld::rival
