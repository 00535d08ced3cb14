// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cluster.h"
#include "kd_tree.h"

namespace scanworld::thesis {

struct PlacingOptions {
  int number_of_clusters = 0;  // stop after so many; 0 = when all points were tried
  int min_points = 6;          // clusters of fewer points are not placed
  double range =
      1.5;  // [delta] half the edge of the box around a point that its cluster is taken from
  double min_distance = 0.35;  // [delta] all points are nearer to the plane than this
};

// Places small clusters: tries the points in the order of a breadth-first walk through the tree and
// takes those around one as a cluster where all of them lie in one plane. A point belongs to one
// cluster at most. Based on: V. Petrik, Spatial Models in Mobile Robotics, 2012, Algorithm 5.
// Different from it: points that belong to a cluster already are not taken by another; the thesis
// leaves open what happens to them.
std::vector<Cluster> place_clusters(const KdTree& tree, double delta,
                                    const PlacingOptions& options = {});

}  // namespace scanworld::thesis
