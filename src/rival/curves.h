// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../curve.h"
#include "cluster.h"
#include "local.h"
#include "neighbors.h"
#include "scale.h"

namespace scanworld::rival {

// Columns and pipes are less than a metre in radius; wider curves are vaults, domes and bent walls.
struct CurveOptions {
  double min_radius = 0.08;  // [m] thinner ones are left to the obstacles
  double max_radius = 8;     // [m] wider ones are walls that are not quite flat
  double roundness = 0.003;  // [radius] that built things are off round, beside the noise
  double max_distance =
      2.5;                 // [noise and roundness] a site with one point is taken from no farther
  double max_rms = 1.6;    // [noise and roundness] one with many may be no rougher
  double max_own = 1.5;    // [noise and roundness] nor may a curve as a whole
  double max_angle = 0.5;  // [rad] between the curve and the planes of its sites' neighbourhoods
  int weight = 12;         // points of a site that count
  int min_points = 200;    // curves of fewer are none
  double min_area = 0.4;   // [m2] and those with less area that has points
  double min_bend = 0.03;  // [m] and those with a smaller sagitta

  double min_height = 0.8;    // [m] of a column or pipe
  double min_slimness = 2.5;  // [radius] and of its height at least
  double min_sweep = 2.4;     // [rad] of its side that was seen
  double min_cover = 0.7;     // share of its extent that has points
  double min_gain = 0.15;     // squared noise per point that planes explain it worse
  double max_turn = 0.15;     // [rad] rms between it and the planes of its neighbourhoods

  double min_taper = 0.02;        // [m] by which a cone's radius grows; else it is a cylinder
  double min_taper_share = 0.08;  // and share of the larger radius

  double min_wide = 1.5;        // [m2 rad2] of a wide one, area times the square of its sweep
  double min_dome = 1.2;        // [rad] sweep of a sphere
  double min_wide_cover = 0.5;  // as min_cover, of a wide one
  double min_wide_gain = -0.4;  // many narrow planes may explain a vault better than one curve
  double max_wide_turn = 0.2;   // [rad] as max_turn

  double max_point_distance = 3;  // [noise and roundness] points farther from a curve are not on it
};

struct Curves {
  std::vector<Curve> curves;
  std::vector<std::int32_t> of_site;  // which curve each site is on, or kNone
};

inline std::size_t count_of(const Curves& curves) { return curves.curves.size(); }

// Finds what is round at large: cylinders, cones and spheres that explain their sites better than
// the planes of `clusters` do. docs/method.md tells how.
Curves find_curves(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                   const std::vector<LocalPlane>& local, const Clustering& clusters,
                   const CurveOptions& options = {});

// Takes the sites of curves out of the rivalry: they are flat nowhere, in no cluster and nobody's
// neighbours.
void set_aside(const Curves& curves, const Grid& grid, Neighbors& neighbors,
               std::vector<LocalPlane>& local, Clustering& clusters);

}  // namespace scanworld::rival
