// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "clutter.h"
#include "fit_solid.h"
#include "round_parts.h"
#include "seen_space.h"
#include "spare_seen.h"
#include "split_clutter.h"

namespace scanworld {

struct ObstacleOptions {
  ClutterOptions clutter;
  RoundPartOptions round;
  SplitClutterOptions split;
  SolidOptions solid;
  SeenSpaceOptions seen;
  SpareSeenOptions spare;
  int max_obstacles = 8192;  // the largest, by the area of their surface
};

OptionList list_options(ObstacleOptions& options);

struct Obstacles {
  std::vector<Obstacle> kept;  // the largest first, with ids from 0
  std::size_t left_out = 0;    // that the budget has no place for
};

inline std::size_t count_of(const Obstacles& obstacles) { return obstacles.kept.size(); }

// Encloses what no surface of a world explains in simple solids: upright cylinders and boxes where
// points lie on one, convex hulls elsewhere, several where one would fill free space.
// docs/obstacles.md tells how.
Obstacles find_obstacles(const PointCloud& cloud, const std::vector<std::int32_t>& labels,
                         const World& world, const ClutterScale& scale,
                         const ObstacleOptions& options = {});

}  // namespace scanworld
