// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cluster.h"
#include "polygons.h"

namespace scanworld::thesis {

// Each cluster's polygon as a surface, with what the scan says of it: the side that is free, its
// support and its colour. `labels`: for each point of the cloud its cluster or -1; `points` and
// `delta`: those of the filter. The free side, which the thesis does not ask for, is that of the
// nearest viewpoint; where none is known, the side on which more of the place lies in front of the
// polygon.
std::vector<FoundSurface> describe_walls(const PointCloud& cloud,
                                         const std::vector<std::int32_t>& labels,
                                         const std::vector<Vec3>& points, double delta,
                                         const std::vector<Cluster>& clusters,
                                         const std::vector<Polygon>& polygons);

}  // namespace scanworld::thesis
