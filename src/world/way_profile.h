// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What can be walked on, cut along the middle of a way.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "plan_grid.h"
#include "upright.h"
#include "world.h"

namespace scanworld {

// Shares of the width of a way, where it is cut along.
inline constexpr std::array kWayLines = {0.25, 0.5, 0.75};

// What looks up, seen from above.
struct WalkLevel {
  std::size_t surface = 0;  // index
  Vec3 normal = Vec3::UnitZ();
  double offset = 0;
  std::vector<std::vector<Vec2>> rings;
  Rectangle box;

  double height(const Vec2& p) const { return height_at(normal, offset, p); }
};

// A way's middle line in plan, from where it goes up.
struct WayAxis {
  Vec2 from = Vec2::Zero(), along = Vec2::UnitX();
  double width = 0;

  Vec2 across() const { return {-along.y(), along.x()}; }
  Vec2 at(double u) const { return from + u * along; }
};

// A piece of a line that lies on a level.
struct WayStretch {
  std::size_t level = 0;
  double from = 0, to = 0;  // [m] along the line
};

// What an axis meets on each of its lines.
struct WayProfile {
  const std::vector<WalkLevel>& levels;
  WayAxis axis;
  std::array<std::vector<WayStretch>, kWayLines.size()> lines;

  double height(const WayStretch& s, double u) const { return levels[s.level].height(axis.at(u)); }
};

// What looks up and is no steeper than a slope [rad].
std::vector<WalkLevel> levels_of(const World& world, const Upright& upright, double max_slope);

// The least and the most along a direction.
std::pair<double, double> range_along(const WalkLevel& level, const Vec2& direction);

// The axis over a level, towards a direction.
WayAxis axis_over(const WalkLevel& level, const Vec2& along);

// Stretches that go on from each other at one height and slope are one, of the longer's level: a
// landing may be several surfaces. The levels must outlive the profile.
WayProfile profile_of(const std::vector<WalkLevel>& levels, const WayAxis& axis);

}  // namespace scanworld
