// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cluster.h"
#include "local.h"

namespace scanworld::rival {

struct GrowthOptions {
  double max_distance = 2.5;  // [noise] a site with one point is taken from no farther
  double max_rms = 1.6;       // [noise] one with many may be no rougher about the plane
  double max_angle = 0.6;     // [rad] between the plane and those of its sites' neighbourhoods
  int min_points = 20;        // clusters of fewer are dropped
};

// Grows clusters over neighbouring free sites, from the flattest first. The observer is told each
// time that their number has doubled, and at the end.
Clustering grow_clusters(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                         const std::vector<LocalPlane>& local, Clustering clustering,
                         const GrowthOptions& options = {}, const Observer& observe = {});

}  // namespace scanworld::rival
