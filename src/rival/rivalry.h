// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cluster.h"
#include "local.h"

namespace scanworld::rival {

struct RivalryOptions {
  int max_sweeps = 8;        // it ends after so many
  double stop_share = 0.02;  // of the changes of the sweep with most: with fewer, it ends
  double smoothness = 4;     // price of a site among others' sites, in squared noise
  double wrong_normal = 2;   // price per point where the neighbourhood's plane is another
  double max_angle = 0.6;    // [rad] another plane is one at more than this
  double no_plane = 7;       // price per point of being in no cluster, in squared noise
  double weight = 12;        // points of a site that count; the others do not add evidence
};

// Clusters compete for sites: each site goes to the cluster near by that explains it at the lowest
// price, and clusters are fitted to what they hold, in turns. The observer is told after each
// sweep.
Clustering compete(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                   const std::vector<LocalPlane>& local, Clustering clustering,
                   const RivalryOptions& options = {}, const Observer& observe = {});

}  // namespace scanworld::rival
