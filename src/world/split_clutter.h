// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "../types.h"

namespace scanworld {

struct SplitClutterOptions {
  double min_gain = 0.06;    // of the volume of a hull that two for its parts leave free
  double min_volume = 2e-3;  // [m3] nor is less than this worth a solid
  int max_parts = 128;       // of one thing
};

using IsSimple = std::function<bool(std::span<const Vec3>)>;

// Parts of a thing whose convex hulls leave free what the thing leaves free, nearly: the cut that
// gains most comes first. `thickness` [m]: what its points are taken to fill around them, so that
// the gaps between them gain nothing. `is_simple` tells the parts that need no cut.
std::vector<std::vector<Vec3>> split_clutter(std::vector<Vec3> points, const Vec3& up,
                                             double thickness, const IsSimple& is_simple,
                                             const SplitClutterOptions& options = {});

}  // namespace scanworld
