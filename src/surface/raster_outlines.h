// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "raster.h"

namespace scanworld::surface {

// The loops around the set cells, which lie to their left; each by the middles of the cells' edges.
// Cells that touch at a corner alone are apart.
std::vector<std::vector<Vec2>> trace_raster(const Raster& raster);

// A loop as a line from its lowest corner and back to it.
std::vector<Vec2> around(std::vector<Vec2> loop);

// The indices, first and last included, at which a line of points may be bent so that none is
// farther off than the tolerance. Source: Douglas, Peucker 1973.
std::vector<std::size_t> straight_ends(const std::vector<Vec2>& points, double tolerance);

// A ring around set cells, or around a hole in the last ring before it that is none.
struct Ring {
  std::vector<Vec2> points;
  bool is_hole = false;
};

// The outlines of the set cells, straight where they are off by no more than the tolerance [cell].
// Those that are nothing then are left out.
std::vector<Ring> outline_rings(const Raster& raster, double tolerance = 1);

}  // namespace scanworld::surface
