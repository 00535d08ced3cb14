// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "types.h"

namespace scanworld {

// A ring of a cluster's polygon; a hole is one in the last ring before it that is none.
struct ReplayLoop {
  int cluster = 0;
  bool is_hole = false;
  std::vector<Vec3> vertices;
};

// What changed from the step before; before the first, no point is in a cluster.
struct ReplayStep {
  std::string stage, text;  // of the method, and what happened, in words
  std::size_t clusters = 0;
  std::size_t changed = 0;            // of all points that the method clusters
  std::vector<std::uint32_t> points;  // that are shown and changed: index into Replay::points
  std::vector<std::int32_t> cluster;  // that each of them is in now, -1 = none
  std::vector<ReplayLoop> loops;      // all polygons at this step
};

// How a method came to its planes, for people to look at. A cluster keeps its number as long as it
// lives; one that is united with a larger one has that one's.
struct Replay {
  std::string method;
  std::vector<Vec3> points;  // some of what the method clusters, in the world's axes
  std::vector<ReplayStep> steps;
};

}  // namespace scanworld
