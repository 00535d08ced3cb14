// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "weld.h"

namespace scanworld::surface {

// For each plane the one that corners are to name in its place: the plane itself, or the first of
// the planes that it is one with there. A polygon's plane is one with that of another polygon if
// its corners are no farther than half of `off_plane` from that, and a plane that only cuts
// polygons is one with a polygon's, or with an earlier one that cuts, if all corners that name it
// are no farther than `same`: the nearest of those that have corners in the same place.
std::vector<int> merge_planes(const std::vector<CornerPolygon>& polygons,
                              const std::vector<Plane>& planes, const WeldOptions& options);

}  // namespace scanworld::surface
