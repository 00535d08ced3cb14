// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "../noise_map.h"
#include "cluster.h"

namespace scanworld::rival {

struct WindowOptions {
  double min_filled = 0.7;  // of a square's edge, as the spread of its points tells it
  double min_points = 40;   // in a square
};

// A square of a cluster's plane, and the plane of the points in it.
struct Window {
  MomentFit fit;
  double square = 0;                  // [m2] of the points off it
  std::vector<std::int32_t> viewers;  // its sites', where they are known
};

// The squares of this size [m] that a cluster fills well enough. None of one that is too narrow.
std::vector<Window> cut_windows(const Grid& grid, const std::vector<std::uint32_t>& sites,
                                const MomentFit& fit, double size,
                                const WindowOptions& options = {});

// The edge of the squares that noise is looked at in [m].
double noise_window(const Grid& grid);

// The noise in the squares of all clusters but those that are rough beside it. `viewpoints`: of the
// cloud, where the sites know theirs.
std::vector<NoiseSample> sample_noise(const Grid& grid, const Clustering& clustering,
                                      const std::vector<Vec3>& viewpoints = {},
                                      const WindowOptions& options = {});

// The noise from place to place, where it is more than that of the whole scan; of more than twice
// as much something else has a part, such as drift.
NoiseMap map_noise(const Grid& grid, const Scale& scale, std::span<const NoiseSample> samples);

}  // namespace scanworld::rival
