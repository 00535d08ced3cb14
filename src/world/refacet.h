// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "world.h"

namespace scanworld {

struct Refaceted {
  World world;
  std::vector<int> kept;  // ids of the curves that keep the facets they have
};

// Cuts what is round into facets anew, so that a chord is off the curve by no more than the sagitta
// [m]. The sides of cylinders and cones become other flat strips along their rulings, and what they
// meet gets the corners of these; solids become hulls of as many sides. Domes keep their facets,
// and so do curves whose new facets would not be valid. Colliders, rooms and doors of a world that
// changes are left to be made anew. Throws usage for a sagitta that is not positive.
Refaceted refacet(World world, double sagitta);

}  // namespace scanworld
