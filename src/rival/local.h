// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "neighbors.h"
#include "scale.h"

namespace scanworld::rival {

struct LocalOptions {
  double max_noise = 1.6;   // [noise] planar is what is no rougher
  double min_extent = 1.5;  // [noise] and what is at least so wide, as a standard deviation
  double min_ratio = 4;     // of the variances along and off the plane, at least
};

// The plane through the points around a site.
struct LocalPlane {
  Vec3f normal = Vec3f::Zero();
  float rank = std::numeric_limits<float>::infinity();  // the less, the flatter; finite if planar
  float ratio = 0;                                      // of the variances along and off the plane

  bool planar() const { return rank < std::numeric_limits<float>::infinity(); }
};

// Fits a plane to the neighbourhood of each site that has neighbours. The others keep theirs in
// `planes`, where there are any; so do those that `only`, where not empty, does not mark.
std::vector<LocalPlane> fit_locally(const Grid& grid, const Neighbors& neighbors,
                                    const Scale& scale, const LocalOptions& options = {},
                                    std::vector<LocalPlane> planes = {},
                                    const std::vector<std::uint8_t>& only = {});

}  // namespace scanworld::rival
