// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "local.h"

namespace scanworld::rival {

struct SidesOptions {
  double min_ratio = 2.5;     // of the variances along and across two layers, at least
  double max_noise = 1.5;     // [noise] each layer may be no rougher
  double min_distance = 3.5;  // [noise] between layers, where they are told by offset alone
  double min_share = 0.15;    // of the points around, in each layer
};

// Keeps both sides of thin walls. Where the points around a site lie in two parallel layers, told
// by their normals where the scan has them, else by a gap in their offsets, the site's points are
// divided: the fewer become a site of their own, and each side has neighbours on its side only.
Grid part_sides(const PointCloud& cloud, Grid grid, const Neighbors& neighbors,
                const std::vector<LocalPlane>& local, const Scale& scale,
                const SidesOptions& options = {});

}  // namespace scanworld::rival
