// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "thesis.h"

namespace scanworld::thesis {

OptionList list_options(ThesisOptions& o) {
  return {
      {"thesis.filter.points_per_dimension", &o.filter.points_per_dimension, "",
       "cubes along the longest extent (the thesis: 100); 0 = by density", 0, 100000},
      {"thesis.filter.points_per_cube", &o.filter.points_per_cube, "",
       "points that a cube in the denser parts of the scan shall hold", 1, 1e6},
      {"thesis.filter.min_size", &o.filter.min_size, "m", "cubes sized by density are not smaller",
       0, 1e6},
      {"thesis.filter.depth_step", &o.filter.depth_step, "1/m",
       "a depth camera's step is this times depth squared; cubes are no smaller than two at the "
       "far end",
       0, 1},
      {"thesis.filter.min_points", &o.filter.min_points, "",
       "cubes with no more points are outliers", 0, 1e9},
      {"thesis.placing.number_of_clusters", &o.placing.number_of_clusters, "",
       "small clusters to place (the thesis: 200); 0 = until all points were tried", 0, 1e9},
      {"thesis.placing.min_points", &o.placing.min_points, "",
       "clusters of fewer points are not placed", 3, 1e9},
      {"thesis.placing.range", &o.placing.range, "delta",
       "half the box that a small cluster is taken from", 0.1, 1e3},
      {"thesis.placing.min_distance", &o.placing.min_distance, "delta",
       "all points of a small cluster are nearer to its plane", 0.001, 1e3},
      {"thesis.spreading.spreading_factor", &o.spreading.spreading_factor, "delta",
       "how far beyond its points a cluster reaches for others", 0, 1e6},
      {"thesis.spreading.min_points", &o.spreading.min_points, "",
       "clusters of fewer points are removed", 3, 1e9},
      {"thesis.spreading.min_points_in_wall", &o.spreading.min_points_in_wall, "",
       "clusters of fewer points in the end are no walls", 3, 1e9},
      {"thesis.spreading.min_distance", &o.spreading.min_distance, "delta",
       "points nearer to a plane are in it", 0.001, 1e3},
      {"thesis.spreading.outliers_range", &o.spreading.outliers_range, "delta",
       "half the box in which a point needs neighbours", 0.1, 1e3},
      {"thesis.spreading.outliers_min_points", &o.spreading.outliers_min_points, "",
       "points of its cluster that a point needs there, itself included", 0, 1e9},
      {"thesis.spreading.stop_share", &o.spreading.stop_share, "",
       "of the changes in the round with most: with fewer, spreading ends", 0, 1},
      {"thesis.spreading.max_rounds", &o.spreading.max_rounds, "",
       "spreading ends after so many rounds", 1, 1e6},
      {"thesis.snapping.max_distance", &o.snapping.max_distance, "delta",
       "vertices are moved no farther", 0, 1e3},
      {"thesis.snapping.evidence_range", &o.snapping.evidence_range, "delta",
       "half the box around a corner in which each wall needs a point", 0, 1e3},
      {"thesis.snapping.min_angle", &o.snapping.min_angle, "rad",
       "planes that meet at less have no line in common", 0.01, 1.5},
      {"thesis.reduction.max_distance", &o.reduction.max_distance, "delta",
       "vertices nearer to their neighbours' line are dropped", 0, 1e3},
  };
}

}  // namespace scanworld::thesis
