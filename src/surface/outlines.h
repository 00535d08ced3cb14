// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arrangement.h"

namespace scanworld::surface {

// The outline of connected cells.
struct Outline {
  struct Corner {
    int vertex;  // of the arrangement
    int line;    // along which the outline leaves it
  };
  using Loop = std::vector<Corner>;

  std::vector<Loop> loops;        // the outer one first, counter-clockwise; holes clockwise
  double covered = 0, empty = 0;  // [m2] as in the cells
};

// One for each connected part of the chosen cells. Loops have corners only where they turn.
std::vector<Outline> trace_outlines(const Arrangement& arrangement,
                                    const std::vector<char>& chosen);

}  // namespace scanworld::surface
