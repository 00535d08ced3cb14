// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut_line.h"
#include "patch.h"

namespace scanworld::surface {

// A patch's rectangle cut into convex cells by lines. Where sides of cells overlap they are
// divided, so that each side has one cell across it, or none at the rectangle's border.
struct Arrangement {
  struct Side {
    int from, to;  // vertices; the cell is to the left
    int line;
    int across = -1;  // the cell on the other side
  };
  struct Cell {
    std::vector<Side> sides;        // counter-clockwise
    double covered = 0, empty = 0;  // [m2] of evidence for and against
  };
  std::vector<Vec2> vertices;
  std::vector<Cell> cells;
};

// Each line cuts the cells that its reach runs through, to their ends; the first lines first.
Arrangement arrange(const Patch& patch, const std::vector<CutLine>& lines);

}  // namespace scanworld::surface
