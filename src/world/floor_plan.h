// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "plan_grid.h"
#include "world.h"

namespace scanworld {

enum class PlanCell : std::uint8_t {
  unknown,   // no floor is known there, and nothing that stands in the way
  free,      // a floor, and nothing over it
  occupied,  // something that a robot would run into
};

struct FloorPlanOptions {
  double cell = 0.05;  // [m] edge
  // [m] over the floor, between which things are in the way: thresholds and what noise leaves on a
  // floor lie lower, the lintels of doors (2 m) higher.
  double low = 0.1, high = 1.8;
  double max_slope = 0.35;  // [rad] of what is a floor to a robot (20 degrees)
  double max_cells = 1e8;   // more are refused
  bool open_glass = false;  // panes are not in the way, as to a lidar
};

// A level raster of a place, as robots plan their ways on.
struct FloorPlan {
  PlanGrid grid;
  double level = 0;  // [m] of the floor, along up
  // From the world's axes to those of the plan, whose z is up: the smallest turn, so that x and y
  // are those of an upright world.
  Eigen::Quaterniond upright = Eigen::Quaterniond::Identity();
  std::vector<PlanCell> cells;  // of the grid

  PlanCell at(const Vec2& p) const {
    const auto i = grid.at(p);
    return i ? cells[*i] : PlanCell::unknown;
  }
};

// The plan of a world at the height of a floor, as wide as the whole world.
// Occupied is every cell that something reaches into between `low` and `high` over the level: a
// surface, an obstacle, a pane of glass, or a collider, so that walls are solid where they are
// known to be. A face on the line between two cells is in the one behind it. Free is every other
// cell over whose centre a surface lies within `low` of the level that is no steeper than
// `max_slope`. Throws usage where there would be more cells than `max_cells`, and check_failed
// naming a surface that is no valid polygon.
FloorPlan make_floor_plan(const World& world, double level, const FloorPlanOptions& options = {});

// The same at the height of the main floor (main_level()).
FloorPlan make_floor_plan(const World& world, const FloorPlanOptions& options = {});

}  // namespace scanworld
