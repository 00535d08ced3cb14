// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "ray_scene.h"

namespace scanworld {

struct FloorQualityOptions {
  double same_level = 0.05;  // [m] pieces of one floor are no farther apart in height where near
  double max_gap = 0.3;      // [m] and not farther aside, with nothing standing between
  double meet = 0.02;        // [m] pieces that are no farther aside meet: a wheel minds no less
  double min_step = 0.005, max_step = 0.03;  // [m] a lower step is none, a higher one is real
  double share = 0.9;                        // of a floor's area: its smallest pieces do not count
  double step = 0.05;                        // [m] between places along edges that are looked at
  double height = 0.1;  // [m] over the floor at which nothing may stand in a gap
};

// Floors that hang together, as one storey's do through its doors.
struct WholeFloor {
  double area = 0;         // [m2]
  std::size_t pieces = 0;  // that make up most of the area, as few as do
};

// What a wheel finds on the floors of a world.
struct FloorQuality {
  std::vector<WholeFloor> floors;  // by area, the largest first
  double area = 0;                 // [m2] of all
  double steps = 0;                // [m] of edges where two pieces of a floor meet in a small step
  double gaps = 0;                 // [m2] between pieces of a floor

  // Of the floor that is worst, by the started 100 m2 of it; 0 where there is no floor.
  double most_pieces() const;
};

FloorQuality measure_floors(const World& world, const RayScene& scene,
                            const FloorQualityOptions& options = {});

}  // namespace scanworld
