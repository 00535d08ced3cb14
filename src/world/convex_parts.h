// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geos.h"

namespace scanworld {

// Parts a valid polygon into few convex ones, counter-clockwise: its constrained Delaunay
// triangles, joined across the longest diagonals first, as long as that stays convex (Hertel and
// Mehlhorn 1983). Corners within `tolerance` [m] of a straight line are left out, and a part may
// stick out of the polygon by so much.
std::vector<std::vector<Vec2>> convex_parts(const geos::Rings& polygon, double tolerance);

// The convex hull, counter-clockwise, without corners on straight edges (Andrew 1979).
std::vector<Vec2> convex_hull(std::vector<Vec2> points);

}  // namespace scanworld
