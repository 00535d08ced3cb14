// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bridge.h"
#include "merge.h"

namespace scanworld::rival {

struct FloorOptions {
  double max_rms = 1.6;      // [noise and bend] of each piece about the plane in common
  double max_tilt = 0.2;     // [rad] off level: floors, ceilings and what is called so
  double max_height = 1.2;   // [m] what is no higher over a larger one is a thing on it
  double max_offset = 0.05;  // [m] between layers: a floor is not seen below itself
  double min_overlap = 0.3;  // share of the lesser one's squares that the other is in as well
};

// Makes one floor, or ceiling, of its pieces: of those that lie in layers, and of those that go on
// into each other without a step, where the plane in common bends no more than a surface may.
Clustering join_floors(const Grid& grid, const Scale& scale, Clustering clustering, const Vec3& up,
                       const FloorOptions& options = {}, const MergeOptions& merge = {},
                       const BridgeOptions& bridge = {});

// Lets the pieces that are left meet: of two that go on into each other the lesser takes a plane
// that does, and each has what is on its side of their common line.
Clustering fold_floors(const Grid& grid, const Scale& scale, Clustering clustering, const Vec3& up,
                       const FloorOptions& options = {}, const MergeOptions& merge = {},
                       const BridgeOptions& bridge = {});

}  // namespace scanworld::rival
