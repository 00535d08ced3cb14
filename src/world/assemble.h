// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "world.h"

namespace scanworld {

// Makes a world of surfaces, in their order: surface i gets the id i. Vertices are rounded to the
// micrometre, and those that are then the same are shared. The sides are those that
// agree_with_neighbors() leaves, the kinds those that classify() gives.
World assemble_world(const std::vector<FoundSurface>& surfaces, const Frame& frame);

// Turns over surfaces that look away from all their neighbours: two that look to the same free
// space go along the edge that they share in opposite directions, so one that does so with none,
// and not so along a third of its outline or more, looks the wrong way, as a door's narrow jamb may
// that few points tell of. Those with the fewest points go first; what is turned counts for the
// next.
void agree_with_neighbors(World& world);

struct ClassifyOptions {
  double max_tilt =
      0.44;  // [rad] floors, ceilings and walls are off level or upright by less (25 degrees)
  double min_wall_height = 1.0;  // [m] upright surfaces that are lower are no walls
  // [m] A level surface that stands so high over a larger one is no floor. What is lower is a floor
  // of its own, as in the next room.
  double min_table_height = 0.03, max_table_height = 2.0;
  double max_table_area = 4.0;  // [m2] what is larger stands only where the other is all around it
};

// Tells the kind of each surface by its slope, facing and place: floors are level, face up and have
// no larger surface that faces up closely below them; ceilings are level and face down; walls are
// upright and high enough.
void classify(World& world, const ClassifyOptions& options = {});

}  // namespace scanworld
