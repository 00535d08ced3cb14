// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "polygons.h"

namespace scanworld::thesis {

// The Delaunay triangulation of a convex polygon with its vertices counter-clockwise seen against
// the normal: vertices.size() - 2 triangles of indices into them, with the same orientation. Based
// on: V. Petrik, Spatial Models in Mobile Robotics, 2012, Algorithm 10. Where rounding lets no ear
// pass (vertices on one circle or one line), the one whose circle reaches in least is cut off.
std::vector<std::array<int, 3>> triangulate_convex(const std::vector<Vec3>& vertices,
                                                   const Vec3& normal);

// The same for the polygon of each cluster.
std::vector<std::vector<std::array<int, 3>>> triangulate(const std::vector<Polygon>& polygons,
                                                         const std::vector<Cluster>& clusters);

}  // namespace scanworld::thesis
