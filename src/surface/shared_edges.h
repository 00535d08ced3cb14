// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "free_edges.h"
#include "seams.h"
#include "surroundings.h"

namespace scanworld::surface {

struct SharedEdgeOptions {
  double max_angle = 0.07;       // [rad] between the planes of edges that are one ...
  double max_offset = 0.03;      // [m] ... and so far they may be off each other's ...
  double max_gap = 0.6;          // [m] ... and so far apart (the two faces of a thick wall)
  double reach = 0.3;            // [m] an edge goes on in a patch whose seam it ends so near to ...
  double length = 0.4;           // [m] ... over so much to both sides
  double reveal_reach = 0.08;    // [m] what is no farther off an edge's plane ...
  double reveal_depth = 0.35;    // [m] ... and so far behind the face may be the edge's reveal ...
  double reveal_spread = 0.015;  // [m] ... if half of it lies within so much
  int reveal_sites = 12;         // at least
};

// An edge of several patches in one plane: that of a doorway in both faces of a wall and in the
// floor between them.
struct SharedEdge {
  Plane plane;
  struct Part {
    int patch;
    Vec3 from, to;
  };
  std::vector<Part> parts;
};

inline std::size_t count_of(const std::vector<SharedEdge>& edges) { return edges.size(); }

// Unites the edges that are nearly in one plane and near each other, and lets them go on into the
// patches that they end at.
std::vector<SharedEdge> share_edges(const std::vector<FreeEdge>& edges,
                                    const std::vector<Patch>& patches,
                                    const std::vector<Seam>& seams,
                                    const SharedEdgeOptions& options = {});

// Moves the planes of edges to what was seen of their reveals: places behind the faces that end
// there. Where a face is sparse its own points tell its end less well.
std::vector<SharedEdge> move_to_reveals(std::vector<SharedEdge> edges,
                                        const std::vector<Patch>& patches,
                                        const Surroundings& around,
                                        const SharedEdgeOptions& options = {});

}  // namespace scanworld::surface
