// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cluster.h"
#include "neighbors.h"
#include "scale.h"

namespace scanworld::rival {

struct EvidenceOptions {
  double min_points = 40;
  double min_area = 0.01;          // [m2]
  double area_noise = 18;          // and the square of this many times the noise
  double min_width = 2.1;          // [voxel] narrower ones are mixtures in the voxels of an edge
  double min_density = 0.1;        // points where the spacing of the scan leads to expect one
  double sparse_points = 300;      // clusters with so many may be less dense ...
  double min_sparse_points = 100;  // ... and those with so many ...
  double min_purity = 0.95;        // ... that hold so much of what is around them ...
  double max_curvature = 0.2;      // ... if a quadric explains no more of their variance
  double explained_share = 0.7;   // of the points that larger clusters next to them explain as well
  double explained_distance = 2;  // [noise] from the larger one's plane
  double small_area = 2;          // [m2] smaller clusters are weighed: they may be pieces of things
  double min_log_odds = -0.9;     // that a small one is a plane; under 0, as one lost costs more
  double prior_share = 0.5;  // of what the scan's own share of planes would add to the odds ...
  double max_prior = 1.5;    // ... and the most of it
};

// What tells a small cluster that is a plane from a piece of something soft or round.
struct Traits {
  double roughness = 0;  // rms off its plane, over that of noise and bend
  double curvature = 0;  // share of its variance off the plane that a quadric explains
  double contact = 0;    // share of its sites that are beside those of other clusters
  double explained = 0;  // share of its points that larger clusters explain as well
  double area = 0;       // [m2]
  double density = 0;    // points where the spacing of the scan leads to expect one
  double fill = 0;       // share that it has of the smallest rectangle around it
};

// The share of the points' variance off their plane that a quadratic surface explains, beyond what
// it would by chance.
double measure_curvature(const Grid& grid, const std::vector<std::uint32_t>& sites,
                         const MomentFit& fit);

// The share that the cells of this size [m] in which sites are have of the smallest rectangle
// around them. Leaves and cushions have rags for borders.
double measure_fill(const Grid& grid, const std::vector<std::uint32_t>& sites, const MomentFit& fit,
                    double cell);

// The logarithm of the odds that a cluster with these traits is a plane.
double log_odds(const Traits& traits);

// Drops the clusters that are no planes: too small or sparse, layers in the noise of larger ones,
// and small ones that look like pieces of something else. What they look like is weighed by odds
// (logistic regression; Cox 1958), which are moved by the share of planes in the scan itself
// (Saerens, Latinne and Decaestecker 2002): amid clutter more is asked of each.
Clustering weigh_evidence(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                          Clustering clustering, const EvidenceOptions& options = {});

}  // namespace scanworld::rival
