// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cells.h"
#include "planes_of_space.h"

namespace scanworld::space {

// Cells of space, and which planes cut them.
struct Arrangement {
  CellComplex cells;
  struct Part {
    int plane;        // index into planes_of_space()'s
    bool is_flipped;  // its normal is against that of the complex
  };
  std::vector<std::vector<Part>> parts;  // by plane of the complex; none of the box's
};

struct ArrangeOptions {
  double pad = 0.25;                // [m] around all points and viewpoints
  double min_touched = 0.02;        // [m2] of a cell that a plane with points cuts, or ...
  double min_share = 0.25;          // ... so much of what the plane is ...
  double min_own = 0.3;             // ... or so much of its section through the cell
  double min_touched_bare = 0.001;  // [m2] of a cell that another plane cuts, or ...
  double min_share_bare = 0.05;     // ... so much of what the plane is
};

// Each plane cuts the cells that its regions touch, whole; in the order given.
Arrangement arrange(const std::vector<SpacePlane>& planes, const Box3& box,
                    const ArrangeOptions& options = {});

}  // namespace scanworld::space
