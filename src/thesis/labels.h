// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cluster.h"
#include "filter.h"
#include "kd_tree.h"

namespace scanworld::thesis {

// For each point of the cloud the cluster that it belongs to, or -1: that of the median that stands
// for it, or of a median near by, whichever plane is nearest and not farther than `max_distance`
// [m].
std::vector<std::int32_t> label_points(const PointCloud& cloud, const FilteredPoints& filtered,
                                       const std::vector<Cluster>& clusters, const KdTree& tree,
                                       double max_distance);

}  // namespace scanworld::thesis
