// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "world.h"

namespace scanworld {

struct ThicknessOptions {
  double min = 0.03;         // [m] faces nearer than this are no two sides of one thing
  double max = 0.6;          // [m] nor are those farther apart
  double max_angle = 0.05;   // [rad] off parallel (3 degrees)
  double min_overlap = 0.5;  // of the smaller face with the other, seen along the normal
};

// Two faces of one wall or slab, back to back.
struct FacePair {
  std::size_t a = 0, b = 0;  // index into World::surfaces, a < b
  double thickness = 0;      // [m] in the middle of what they have in common
  double overlap = 0;        // [m2]
};

// All pairs of surfaces that are the two faces of something: opposed, back to back, with nothing
// between them. The order is that of the surfaces.
std::vector<FacePair> pair_faces(const World& world, const ThicknessOptions& options = {});

// Gives each surface the thickness of the pair that it shares most with; of those that are as good,
// the thinnest. Surfaces without a pair keep what they have.
void set_thickness(World& world, const std::vector<FacePair>& pairs);

OptionList list_options(ThicknessOptions& options);

}  // namespace scanworld
