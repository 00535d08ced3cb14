// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>

#include "world.h"

namespace scanworld {

struct SimplifyOptions {
  bool simple_obstacles = false;  // hulls become the upright box or cylinder with less in it
  double min_size = 0;  // [m] obstacles, and surfaces that are neither floor, ceiling nor wall,
                        // that extend less far are left out
};

// A world with less in it to collide with. Floors, ceilings and walls stay as they are. With a
// surface go its openings, doors and solids; ids stay.
World simplify(World world, const SimplifyOptions& options);

// The upright box or cylinder, whichever holds less, around a hull.
std::variant<OrientedBox, Cylinder> simple_solid(const ConvexHull& hull, const Vec3& up);

// Lets openings and ways forget the surfaces that are not among those that are kept, where they can
// do without: leaves, and the floors that a way begins and ends on.
void forget_missing_surfaces(const std::set<int>& kept, World& world);

// Removes what refers to surfaces and openings that are gone, and vertices that nothing refers to.
void drop_dangling(World& world);

// Removes vertices that nothing refers to.
void drop_vertices(World& world);

// The ids of the surfaces of a world.
std::set<int> surface_ids(const World& world);

}  // namespace scanworld
