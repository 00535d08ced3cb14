// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The floor plan that people read: walls cut at a height, openings, rooms and dimensions. The one
// that robots use is world/floor_plan.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "world/world.h"

namespace scanworld {

struct DrawnPlanOptions {
  double cut = 1.2;           // [m] over the floor: through doors and most windows
  std::optional<int> storey;  // 0 for the lowest; where not given, that of the largest floor
  double min_room = 0.3;      // [m] a room's width that is told, at least
};

// Lengths and places in metres, in the x and y of the world turned upright.
struct DrawnPlan {
  struct Line {
    Vec2 a, b;
  };
  struct Opening {
    Vec2 a, b;  // its ends, seen from above
    OpeningKind kind = OpeningKind::door;
    double width = 0;  // clear
    bool glass = false;
  };
  struct Room {
    Vec2 at;  // for its name
    std::string name;
    std::optional<double> area;  // [m2]
  };
  // A length between two places, written along the line between them.
  struct Dimension {
    Vec2 a, b;
    double length() const { return (b - a).norm(); }
  };

  double level = 0, cut = 0;                           // heights of the floor and the cut
  std::vector<std::vector<std::vector<Vec2>>> floors;  // rings of each, its holes too
  std::vector<std::vector<Vec2>> solids;               // of walls, cut: convex
  std::vector<std::vector<Vec2>> things;               // obstacles, seen from above: convex
  std::vector<Line> walls;                             // surfaces, cut
  std::vector<Opening> openings;                       // over the storey's floor
  std::vector<Room> rooms;
  std::vector<Dimension> widths;  // of rooms, from wall to wall past the name
  std::vector<Dimension>
      overall;  // of all walls with their solids, along and across most of them; drawn outside
  Vec2 along = Vec2::UnitX();  // unit vector of the way that most walls go
};

// Throws usage where there is no such storey, and check_failed naming a surface that is no valid
// polygon.
DrawnPlan draw_plan(const World& world, const DrawnPlanOptions& options = {});

// As SVG, in centimetres, with a scale in its head at which it fits on A3.
std::string svg_of(const DrawnPlan& plan, const std::string& title);

}  // namespace scanworld
