// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "ellipsoid.h"

namespace scanworld {

struct RoundPartOptions {
  double tolerance = 2;      // [noise] points no farther from an ellipsoid lie on it
  int min_points = 60;       // thinned ones, on an ellipsoid
  double min_seen = 0.3;     // of an ellipsoid's directions, with points
  double max_unknown = 2.5;  // [noise] standard deviation of where its unseen side is
  double max_inside = 0.05;  // points deep inside, for each on it
  double max_beside = 0.5;   // points a little off it, for each on it
  double max_biased = 0.3;   // points where it is off them on the whole, for each on it
  double max_ratio = 8;      // of its longest to its shortest axis
};

struct RoundParts {
  std::vector<Ellipsoid> found;
  std::vector<std::vector<Vec3>> rest;  // connected points that are on and in none
};

// The ellipsoids that parts of a thing lie on, each seen from enough sides to tell where it ends on
// the others. `cell` [m]: points no farther from each other are connected. `is_possible` tells
// those that may be, as some were seen from inside.
RoundParts find_round_parts(std::span<const Vec3> thing, double cell, double noise,
                            const RoundPartOptions& options = {},
                            const std::function<bool(const Ellipsoid&)>& is_possible = {});

}  // namespace scanworld
