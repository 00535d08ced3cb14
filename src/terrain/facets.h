// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../world/geos.h"
#include "heights.h"

namespace scanworld::terrain {

// A flat piece of ground seen from above: the height at p is slope * p + base.
struct Facet {
  geos::Rings rings;
  Vec2 slope = Vec2::Zero();
  double base = 0;                 // [m]
  std::vector<std::size_t> cells;  // whose middles are in it
  std::size_t seen = 0;            // of these, how many were

  double height_at(const Vec2& p) const { return slope.dot(p) + base; }
};

// The wanted cells as few facets that share their corners and are off the height of no cell
// that was seen by more than `error` [m]. A Delaunay triangulation of places, to which the worst of
// each triangle is added until none is bad (Garland and Heckbert 1995), cut along the outline of
// the cells. All wanted cells must be known.
std::vector<Facet> cut_facets(const Heights& heights, const surface::Raster& wanted,
                              const surface::Raster& seen, double error);

}  // namespace scanworld::terrain
