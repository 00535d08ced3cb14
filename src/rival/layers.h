// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "cluster.h"
#include "scale.h"

namespace scanworld::rival {

struct LayerOptions {
  double max_offset = 0.1;   // [m] between layers of one surface; 0 = all are surfaces of their own
  double min_offset = 0.6;   // [voxel] nearer ones are the heights and depths of what is rough
  double max_angle = 0.1;    // [rad] between their normals
  double cell = 1.5;         // [voxel] edge of the squares in which two are compared
  double min_overlap = 0.3;  // share of the lesser layer's squares that the other is in as well
  double room = 0.3;         // [m] a side has at least so much room before it
  double min_share = 0.015;  // of the scan's area that is in layers, for its registration to drift
  double bend = 0.4;         // drift: what a surface may then bend by, and over each metre
};

// Surfaces that a scan shows more than once, a little apart.
struct Layers {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;  // of clusters, the larger first
  double offset = 0;  // [m] between the two of a pair, the median over their area
  double share = 0;   // that is in pairs, of the area of all clusters
};

// Layers are seen from one side, as where a registration drifts between two visits. The two sides
// of a thin wall are none: each has room before it, up to what is seen across.
Layers find_layers(const Grid& grid, const Scale& scale, const Clustering& clustering,
                   const LayerOptions& options = {});

// How flat a scan's surfaces are with these layers. Where they are many the scan drifts, and its
// surfaces may bend accordingly.
Flatness allow_drift(Flatness flatness, const Layers& layers, const LayerOptions& options = {});

// Makes one surface of the layers of each, in a scan that drifts.
Clustering join_layers(const Grid& grid, const Scale& scale, Clustering clustering,
                       const LayerOptions& options = {});

}  // namespace scanworld::rival
