// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Point sets with known planes, and worlds to test with.
#pragma once

#include "support.h"
#include "world/world.h"

namespace scanworld::test {

// Points of a rectangle from `corner` along `a` and `b`, on a jittered grid, with Gaussian noise
// along the normal.
void add_rectangle(PointCloud& cloud, const Vec3& corner, const Vec3& a, const Vec3& b,
                   double spacing, double noise, Random& random);

// A closed room of this size with its corner at the origin, seen from inside: floor, ceiling and
// four walls.
PointCloud room_points(const Vec3& size, double spacing, double noise, std::uint64_t seed = 1);

PointCloud cloud_of(const std::vector<Vec3>& points);
void shuffle_points(PointCloud& cloud, std::uint64_t seed);  // and their viewers

// A level rectangle seen from above, and an upright one over a line on the floor, seen from its
// left.
FoundSurface level_rectangle(double x0, double y0, double x1, double y1, double height);
FoundSurface upright_rectangle(const Vec3& from, const Vec3& to, double height);

// Just these surfaces.
World world_with(const std::vector<FoundSurface>& surfaces);

// The surfaces of an open box: floor, and a wall with a window hole.
World small_world();

// A world with something of everything that world.json can hold.
World full_world();

// The same place so many times as large: its vertices and planes.
World scaled(World world, double factor);

}  // namespace scanworld::test
