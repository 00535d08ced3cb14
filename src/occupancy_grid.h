// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "types.h"

namespace scanworld {

// The logarithm of the odds of a probability.
inline float log_odds_of(double probability) {
  return static_cast<float>(std::log(probability / (1 - probability)));
}

// The sensor model of Hornung et al., OctoMap (2013), with the values of their library.
struct OccupancyOptions {
  double resolution = 0.1;     // [m] edge of a cell
  double hit = 0.7;            // probability that a cell is occupied which a point is in
  double miss = 0.4;           // and one that is looked through
  double lowest = 0.1192;      // what all probabilities are kept above ...
  double highest = 0.971;      // ... and below
  std::size_t min_points = 1;  // a cell with fewer points has none
};

}  // namespace scanworld
