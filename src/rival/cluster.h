// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "grid.h"

namespace scanworld::rival {

constexpr std::int32_t kNone = -1;

// Sites that lie in one plane.
struct Cluster {
  Moments moments;
  MomentFit fit;
};

// Which cluster each site is in, or kNone.
struct Clustering {
  std::vector<std::int32_t> label;
  std::vector<Cluster> clusters;
  // Of each site, as of when it last competed: whether a cluster other than its own is among its
  // neighbours; and whether any site that has it among its own neighbours has changed since. Where
  // the density changes, a site may have neighbours of which it is none; their changes it does not
  // see.
  std::vector<std::uint8_t> border, awake;

  bool may_border(std::size_t site) const { return border[site] || awake[site]; }
  const Plane& plane(std::int32_t l) const {
    return clusters[static_cast<std::size_t>(l)].fit.plane;
  }
};

inline std::size_t count_of(const Clustering& c) { return c.clusters.size(); }

constexpr double kMinPoints = 12;  // that a cluster needs for its plane to mean something

// Fits all clusters to their sites and drops those with fewer than kMinPoints points.
void refit(const Grid& grid, Clustering& clustering);

}  // namespace scanworld::rival
