// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cluster.h"
#include "neighbors.h"
#include "scale.h"

namespace scanworld::rival {

struct LabelOptions {
  double max_distance = 3;  // [noise] points farther from a plane are not in it
  double max_own = 3;       // [noise of the plane] nor points farther than this
  double min_noise = 0.25;  // [noise] a plane's own noise is at least this
  double smoothness = 3;    // price of a point among other clusters' sites, in squared noise
  int min_points = 50;      // planes with fewer points in the end are dropped
};

// A plane that has points.
struct LabelledPlane {
  MomentFit fit;
  double noise = 0;  // [m] standard deviation of the points off it; none is farther than
                     // LabelOptions::max_own times this, or the noise there
};

struct LabelledPoints {
  std::vector<std::int32_t> labels;  // for each point of the cloud its plane, or kNone
  std::vector<LabelledPlane> planes;
  std::vector<std::int32_t> sites;  // for each voxel the plane of its cluster, or kNone
};

inline std::size_t count_of(const LabelledPoints& points) { return points.planes.size(); }

// Gives each point to the cluster whose plane is nearest, of those around.
LabelledPoints label_points(const PointCloud& cloud, const Grid& grid, const Neighbors& neighbors,
                            const Scale& scale, const Clustering& clustering,
                            const LabelOptions& options = {});

}  // namespace scanworld::rival
