// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "world.h"

namespace scanworld {

// How far a vertex may lie off the plane of its surface [m].
inline constexpr double kPlanarTolerance = 1e-3;

// No vertex or solid of a world reaches farther from its origin [m]; scans are moved to theirs.
inline constexpr double kWorldReach = 20000;

// What is wrong with a world, in words, each naming the element and the value; empty for a valid
// world. Valid is: numbers are finite and places within reach; ids are unique and refer to what
// exists; loops have three different vertices or more, lie in their plane, and turn the right way;
// polygons do not cross themselves, and holes lie inside, apart from each other; solids have a
// size, and the bases of prisms are flat and convex; doors join two rooms. The order of the reasons
// is that of the world.
std::vector<std::string> validate(const World& world);

}  // namespace scanworld
