// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cluster.h"

namespace scanworld::thesis {

// A wall's border: its corners, counter-clockwise seen against the normal of its cluster's plane.
using Polygon = std::vector<Vec3>;

// Each cluster's points, moved to the nearest point of its plane.
// Based on: V. Petrik, Spatial Models in Mobile Robotics, 2012, section 6.1.
std::vector<std::vector<Vec3>> fit_to_planes(const std::vector<Vec3>& points,
                                             const std::vector<Cluster>& clusters);

// The convex border of each cluster's points, which must lie in its plane; fewer than three corners
// where they are all on one line.
std::vector<Polygon> find_borders(const std::vector<std::vector<Vec3>>& points,
                                  const std::vector<Cluster>& clusters);

}  // namespace scanworld::thesis
