// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "open_gaps.h"
#include "scale.h"

namespace scanworld::rival {

struct BridgeOptions {
  double max_gap = 8;       // [voxels] between two clusters with a plane in common
  double max_rms = 1.35;    // [noise] of each about that plane
  double open_share = 0.5;  // of the shortest ways across a gap that nothing may cross, at least

  double piece_gap = 0.4;    // [m] between two pieces of one surface
  double max_step = 0.006;   // [m] from one to the other in the midst of the gap
  double max_angle = 0.035;  // [rad] between them
};

// The gaps across which clusters may be one before it is known what is a surface.
GapOptions gaps_of_clusters(const Grid& grid, const BridgeOptions& options);

// Unites clusters with one plane across a gap that no other cluster goes through: a wall that is
// sparse or hidden in places is one wall.
Clustering bridge_clusters(const Grid& grid, const Scale& scale, Clustering clustering,
                           const BridgeOptions& options = {});

// Unites clusters that are known to be surfaces, across gaps that something before or behind may
// hide. What decides is whether they go on into each other without a step: surfaces bend, and to
// those far apart no plane is common. In noise of more than a step nothing is united: there the
// fronts of goods beside each other have none either.
Clustering bridge_pieces(const Grid& grid, const Scale& scale, Clustering clustering,
                         const BridgeOptions& options = {});

}  // namespace scanworld::rival
