// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kd_tree.h"
#include "polygons.h"

namespace scanworld::thesis {

struct SnappingOptions {
  double max_distance = 3;  // [delta] vertices are moved no farther than this
  double evidence_range =
      4;  // [delta] half the edge of the box around a corner in which each wall needs a point
  double min_angle =
      0.35;  // [rad] planes that meet at a smaller angle have no line in common worth the name
};

// Moves the vertices of each cluster's polygon to the nearest corner of three planes, else to the
// nearest line of two, where these are near enough and each of the clusters has points there; the
// polygons are then made convex again. Polygons that meet in a corner get the same vertex, bit for
// bit. Based on: V. Petrik, Spatial Models in Mobile Robotics, 2012, Algorithm 8.
std::vector<Polygon> snap_vertices(const std::vector<Polygon>& polygons,
                                   const std::vector<Cluster>& clusters, const KdTree& tree,
                                   double delta, const SnappingOptions& options = {});

struct ReductionOptions {
  double max_distance =
      0.5;  // [delta] vertices nearer than this to their neighbours' line are dropped
};

// Drops the vertices that are nearly on the line of their neighbours; three always stay.
// Based on: V. Petrik, Spatial Models in Mobile Robotics, 2012, Algorithm 9.
std::vector<Polygon> reduce_vertices(std::vector<Polygon> polygons, double delta,
                                     const ReductionOptions& options = {});

}  // namespace scanworld::thesis
