// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cluster.h"
#include "neighbors.h"
#include "scale.h"

namespace scanworld::rival {

struct RoughOptions {
  double max_roughness = 0.03;  // [m] that is looked for; half more is found; 0 = all are smooth
  double step = 3;              // by which roughness is less, each time that is looked
  double min_roughness = 1.5;   // [noise] what is less rough is found without
  double min_area = 2;          // [m2] of a rough surface
  double min_width = 20;        // [roughness] and of its lesser extent
  double min_fill = 0.6;        // share that it has of the smallest rectangle around it
  double max_beside = 0.35;     // sites before or behind it that are left, against its own
  double max_curvature = 0.3;   // share of its roughness that a quadratic surface explains
  double small_area = 0.25;     // [m2] smaller clusters within its roughness are pieces of it
  double max_smoother = 3.5;    // and larger ones, if they are no more times smoother
};

// The roughness of surfaces that are looked for, the least first [m].
std::vector<double> list_roughness(const Scale& scale, const RoughOptions& options = {});

// The sites in no cluster, as the points of a coarser look at the scan.
struct Leftover {
  PointCloud places;                 // the means of the sites' points
  std::vector<std::uint32_t> sites;  // of each place
};

Leftover find_leftover(const Grid& grid, const Neighbors& neighbors, const Clustering& clustering);

// Takes over the clusters that were found in what is left, with `coarse` for their grid, as far as
// they are rough surfaces: larger than clutter, with nothing before or behind them, no rags, and
// worth it: each site that is explained counts for them, each that others explain better, and that
// they take along, against.
Clustering take_rough(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                      Clustering clustering, const Leftover& left, const Grid& coarse,
                      const Clustering& found, const RoughOptions& options = {});

}  // namespace scanworld::rival
