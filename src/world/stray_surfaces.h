// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "world.h"

namespace scanworld {

struct StrayOptions {
  double near = 0.05;      // [m] a surface meets what comes so near to its outline
  double inside = 0.05;    // [m] from both outlines: where surfaces cross farther inside
  double min_angle = 0.2;  // [rad] between surfaces that cross (11 degrees)
  double step = 0.05;      // [m] between places that are looked at
};

// Surfaces as no building has them.
struct StraySurfaces {
  std::vector<int> floating;  // ids of those that meet nothing, but the largest
  double floating_area = 0;   // [m2] of them
  double area = 0;            // [m2] of all
  double crossings = 0;       // [m] over which two surfaces go through each other
  double edges = 0;           // [m] of all outlines, those between two surfaces once
};

StraySurfaces find_stray_surfaces(const World& world, const StrayOptions& options = {});

}  // namespace scanworld
