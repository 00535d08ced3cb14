// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cut_line.h"
#include "patch.h"

namespace scanworld::surface {

struct FreeEdgeOptions {
  double near_seam = 2.2;    // [cell] outlines no farther from a seam are explained by it
  double tolerance = 1.2;    // [cell] an outline is straight where it is off a chord by no more
  double min_length = 0.15;  // [m] of a straight piece
  double snap_angle = 0.12;  // [rad] pieces are parallel or square to a seam if they nearly are
  double max_chamfer = 0.5;  // [m] of a corner between two such pieces that the outline cuts off
};

// A straight piece of a patch's outline where it meets no other patch.
struct FreeEdge {
  int patch = 0;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  Plane plane;  // through it, square to the patch, its normal away from the patch
};

// `lines`: the seams of the patch.
std::vector<FreeEdge> find_free_edges(const PointCloud& cloud,
                                      std::span<const std::uint32_t> members, const Patch& patch,
                                      const std::vector<CutLine>& lines,
                                      const FreeEdgeOptions& options = {});

}  // namespace scanworld::surface
