// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "world.h"

namespace scanworld {

// Solids as closed triangle meshes, counter-clockwise seen from outside.
Mesh mesh_of(const OrientedBox& box);
Mesh mesh_of(const ConvexPrism& prism);

// The sides are `facets` flat faces whose corners lie on the cylinder.
Mesh mesh_of(const Cylinder& cylinder, const Vec3& up, int facets = 24);

// By Qhull. Throws check_failed where the points have no volume.
Mesh mesh_of(const ConvexHull& hull);

Mesh mesh_of(const Obstacle& obstacle, const Frame& frame);

// Whether a point is in a convex solid.
bool contains(const Mesh& convex, const Vec3& point);

// The normal of a triangle, as long as its area [m2].
Vec3 vector_area(const Mesh& mesh, std::size_t triangle);

// Of a closed mesh [m3], and of any [m2].
double volume_of(const Mesh& mesh);
double area_of(const Mesh& mesh);

}  // namespace scanworld
