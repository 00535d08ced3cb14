// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "world.h"

namespace scanworld {

// The surfaces of a world as triangles that share its vertices.
struct WorldMesh {
  Mesh mesh;                 // vertices: those of the world
  std::vector<int> surface;  // for each triangle the index into World::surfaces
};

// Constrained Delaunay triangulation of every surface, holes left open, counter-clockwise seen from
// the free side. Every vertex of a loop is a vertex of its triangles, also where it lies on a
// straight edge, so that neighbours that share vertices share edges. Throws check_failed naming the
// surface that is no valid polygon.
WorldMesh triangulate(const World& world);

}  // namespace scanworld
