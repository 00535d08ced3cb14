// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "cluster.h"
#include "kd_tree.h"

namespace scanworld::thesis {

struct SpreadingOptions {
  double spreading_factor = 5;  // [delta] how far beyond its points a cluster reaches for others
  int min_points = 6;           // clusters of fewer points are removed
  int min_points_in_wall = 12;  // clusters of fewer points in the end are no walls
  double min_distance = 0.4;    // [delta] points nearer to the plane than this are in it
  double outliers_range =
      1.1;  // [delta] half the edge of the box in which a point needs neighbours
  int outliers_min_points =
      4;                      // points of its own cluster that a point needs there, itself included
  double stop_share = 0.005;  // of the changes in the round with most: with fewer, spreading ends
  int max_rounds = 100;       // spreading ends after so many rounds at the latest
};

// Told of the clusters after a round; it changes nothing.
using SpreadingObserver = std::function<void(const std::vector<Cluster>& clusters)>;

// Enlarges and unites clusters until they no longer change much. In each round each cluster takes
// the points in its plane and reach that no larger cluster owns, and gives up those that are off
// its plane or lie alone. A point of a cluster of the same size stays there. The clusters come out
// with the largest first. Based on: V. Petrik, Spatial Models in Mobile Robotics, 2012,
// Algorithm 6. Different from it: a round's changes are the points that have another owner after it
// than before, so that points taken and given up in each round do not count; and the number of
// rounds is bounded. The observer is told after each round.
std::vector<Cluster> spread_clusters(const KdTree& tree, double delta,
                                     std::vector<Cluster> clusters,
                                     const SpreadingOptions& options = {},
                                     const SpreadingObserver& observe = {});

}  // namespace scanworld::thesis
