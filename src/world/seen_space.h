// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../cell_set.h"
#include "world.h"

namespace scanworld {

struct SeenSpaceOptions {
  int max_lines = 200'000;  // lines of sight that are followed
  int max_places = 4'000;   // of surfaces, that look at each other
  double min_cosine = 0.2;  // of a line between two of them to the normal of either
};

// The cells that were looked through and hold no point.
struct SeenSpace {
  double cell = 0.1;  // [m] edge of one
  CellSet through;
  bool from_viewpoints = false;  // else between surfaces

  bool contains(const Eigen::Vector3i& at) const;
  // The middles of those in a box.
  std::vector<Vec3> in(const Box3& box) const;
};

// What was seen to be free in a box, about. Where viewpoints are known, that is what is between
// them and the points that they saw, as the points know or else as it seems; where none is, what is
// between any two places on surfaces that face each other, with no point in between. `cell` [m]: a
// sampled surface has points in each such cell.
SeenSpace find_seen_space(const PointCloud& cloud, const World& world, const Box3& where,
                          double cell, const SeenSpaceOptions& options = {});

}  // namespace scanworld
