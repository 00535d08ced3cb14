// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "world.h"

namespace scanworld {

// A line along which a scanner saw a point.
struct SightLine {
  Vec3 from, to;
};

struct OpeningOptions {
  double min_width = 0.3, min_height = 0.3;  // [m] clear
  double sill = 0.15;            // [m] what ends no higher over the wall's bottom is a door or a
                                 // passage
  double min_door_height = 1.7;  // [m] clear; lower ones count where they go through both faces
  double max_door_height = 2.6, max_door_width = 1.6;  // [m] larger ones are passages
  double squareness = 0.7;     // least share of an opening that is its clear rectangle
  double max_thickness = 0.6;  // [m] of a wall whose two faces have the same opening
};

// The doors, windows and passages of walls: their holes, and notches that begin at the bottom. The
// clear size is that of the largest upright rectangle in it, and where both faces of a wall have
// the opening, the smaller of both; it is told once, on the surface with the smaller id.
// `sight_lines` may be empty; those that go through an opening are counted in its evidence.
std::vector<Opening> find_openings(const World& world, std::span<const SightLine> sight_lines = {},
                                   const OpeningOptions& options = {});

}  // namespace scanworld
