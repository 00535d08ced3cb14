// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "world.h"

namespace scanworld {

// A valid world, and what was done to get it.
struct Mended {
  World world;
  std::vector<std::string> warnings;  // each names a thing, and its place in the scan's coordinates
  std::vector<std::size_t> from;      // of each surface, the index of the one that it is part of
};

// Makes a sound polygon of each surface, one that validate() and triangulate() take: a polygon that
// crosses or touches itself, falls apart or leaves its plane becomes the sound ones in it, the
// largest first, which keeps the support. Corners stay where they are as far as can be. What holds
// nothing sound is left out. Surface i gets the id i. It looks at surfaces alone: openings, solids
// and rooms are to be made of what it gives.
Mended mend_surfaces(World world);

// Leaves out whatever keeps a world from being valid or triangulated, and what refers to that; ids
// stay. Here and above, ids must be unique and vertices that are referred to exist.
Mended leave_out_invalid(World world);

}  // namespace scanworld
