// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "weld.h"

namespace scanworld::surface {

// Polygons whose corners are told by planes: first those of the patches, then those of the free
// edges, then four around each patch.
struct Pieces {
  std::vector<Plane> planes;
  int patches = 0, edges = 0;           // so many planes are of patches, of free edges
  std::vector<CornerPolygon> polygons;  // by patch; those in planes of free edges come last

  bool is_patch(int plane) const { return plane < patches; }
  bool is_edge(int plane) const { return plane >= patches && plane < patches + edges; }
};

inline std::size_t count_of(const Pieces& pieces) { return pieces.polygons.size(); }

struct RevealOptions {
  double max_tilt = 0.26;       // [rad] between the two faces of a wall (15 degrees)
  double min_thickness = 0.01;  // [m] of a wall ...
  double max_thickness = 0.6;   // [m] ... that is closed at its ends
  double min_length = 0.05;     // [m] of an end
};

// Closes the ends of walls: where both faces of one end along the same free edge, as at a doorway,
// a window or a free end, adds the strip between them in the edge's plane. Its corners are those of
// the faces, so that nothing gapes.
Pieces add_reveals(Pieces pieces, const RevealOptions& options = {});

}  // namespace scanworld::surface
