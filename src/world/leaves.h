// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../options.h"
#include "world.h"

namespace scanworld {

struct LeafOptions {
  double max_thickness = 0.08;  // [m] of a leaf; more is a wall or a cupboard
  double max_off = 0.15;        // share of the opening's width and height that a leaf's are off
  double max_aside = 0.12;      // [m] from the side of the opening to the leaf's hinge
  double max_depth = 0.35;      // [m] the same through the wall: leaves hang at either face
  double min_angle = 0.15;      // [rad] from closed
};

OptionList list_options(LeafOptions& options);

// The leaves that stand in doors and passages: upright, as thin, wide and high as the opening is
// filled by, with one end at its side. Of several the one with the most points. Surfaces must know
// their thickness.
std::vector<Opening> hang_leaves(const World& world, const LeafOptions& options = {});

}  // namespace scanworld
