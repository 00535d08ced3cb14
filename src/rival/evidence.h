// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cluster.h"
#include "neighbors.h"
#include "scale.h"

namespace scanworld::rival {

struct EvidenceOptions {
  double min_points = 60;
  double min_area = 0.04;         // [m2]
  double area_noise = 18;         // and the square of this many times the noise
  double min_width = 2.1;         // [voxel] narrower ones are mixtures in the voxels of an edge,
  double min_breadth = 0.095;     // [m] or rims of things
  double max_roughness = 1.3;     // [noise and bend] rms of the points off a small one
  double min_density = 0.1;       // points where the spacing of the scan leads to expect one
  double sparse_points = 300;     // clusters with so many may be less dense
  double explained_share = 0.7;   // of the points that larger clusters next to them explain as well
  double explained_distance = 2;  // [noise] from the larger one's plane
  double small_area = 2;          // [m2] smaller clusters may be pieces of something round
  double bend_share = 0.05;       // of the variance off the plane that a bend may explain
  double bend_chance = 15;        // over the number of points: the share that chance may explain
  double bend_height = 0.3;       // [noise] rms of a bend that counts
  double min_curvature = 0.3;     // [1/m] flatter bends are those of real walls and of calibration,
  double high_bend = 0.005;       // [m] unless their rms is more than this
  double surrounded = 0.5;        // points in no cluster around a small one, per point of its own
  double surrounded_area = 0.5;   // [m2] of a small one in this sense
  int surrounded_rounds = 3;
};

// Drops the clusters that are no planes: too small or sparse, layers in the noise of larger ones,
// bent, or going on as something round.
Clustering weigh_evidence(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                          Clustering clustering, const EvidenceOptions& options = {});

}  // namespace scanworld::rival
