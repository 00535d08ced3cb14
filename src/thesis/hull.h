// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../types.h"

namespace scanworld::thesis {

// The convex hull of points in a plane: its corners counter-clockwise seen against the normal, none
// of them on the line of its neighbours. Fewer than three corners where all points are on one line.
// Based on: T. Lambert, Incremental algorithm for computing the convex hull of points, 1998
// (Algorithm 7 of the thesis): each point that sees edges of the hull so far replaces them by two.
std::vector<Vec3> convex_hull(const std::vector<Vec3>& points, const Vec3& normal);

// True where `p` is on the outer side of the plane through the edge from `a` to `b` and the normal,
// farther from it than rounding goes (isSeeing of the thesis).
bool is_seeing(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& normal);

}  // namespace scanworld::thesis
