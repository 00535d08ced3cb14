// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clearance.h"

namespace scanworld {

struct SlabOptions {
  double depth = 0.1;         // [m] of a floor, ceiling or wall whose thickness is not known
  double other_depth = 0.04;  // [m] of anything else: tables, steps, sides of things
  double max_beside = 0.25;   // [m] a side of a thing tells its depth if it is no larger, or if the
                              // face is closed all around
  double max_depth = 1.0;     // [m] of what is known by its sides
  double gap = 0.01;          // [m] neighbours no farther apart touch
  double overlap = 0.01;      // [m] of slabs that go on flat
  double min_width = 0.02;    // [m] narrower strips of a face get no slab of their own
  double tolerance = 0.001;   // [m] slabs stick out of faces by no more
};

// Faces with all that is known of what is behind them.
struct FaceDepths {
  std::vector<std::vector<std::vector<FaceEdge>>> edges;  // of each face, ring by ring
  std::vector<double> depth;                              // [m] of each face
};
FaceDepths find_depths(const std::vector<Face>& faces, const SlabOptions& options);

// Slabs behind face `i` that cover it: boxes where it is rectangular, else convex prisms, whichever
// are fewer. At concave corners they go on behind the neighbour. Those in `made` may cover parts of
// it already.
std::vector<Slab> slabs_of(const std::vector<Face>& faces, const FaceDepths& depths, std::size_t i,
                           const Slabs& made, const Clearance& clearance,
                           const SlabOptions& options);

}  // namespace scanworld
