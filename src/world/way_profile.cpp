// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "way_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace scanworld {

namespace {

constexpr double kJoint = 0.05;       // [m] between pieces of one floor
constexpr double kSameLevel = 0.03;   // [m] the same in height
constexpr double kSameSlope = 0.999;  // cosine of 2.6 degrees

// Where a line goes over a level.
void add_stretches(const WalkLevel& level, std::size_t index, const Vec2& origin, const Vec2& along,
                   std::vector<WayStretch>& stretches) {
  const Vec2 across(-along.y(), along.x());
  if (std::abs(across.dot(level.box.center() - origin)) > level.box.diagonal().norm() / 2) return;
  std::vector<double> ends;
  for (const auto& ring : level.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 p = ring[i] - origin, q = ring[(i + 1) % ring.size()] - origin;
      const double a = across.dot(p), b = across.dot(q);
      if ((a < 0) == (b < 0)) continue;
      ends.push_back(along.dot(p) + along.dot(q - p) * (a / (a - b)));
    }
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
    stretches.push_back({index, ends[i], ends[i + 1]});
}

std::vector<WayStretch> joined(std::vector<WayStretch> stretches, const WayProfile& profile) {
  std::sort(stretches.begin(), stretches.end(), [](const WayStretch& a, const WayStretch& b) {
    return std::tie(a.from, a.to, a.level) < std::tie(b.from, b.to, b.level);
  });
  std::vector<WayStretch> result;
  for (const WayStretch& s : stretches) {
    const auto before = std::find_if(result.begin(), result.end(), [&](const WayStretch& r) {
      return s.from <= r.to + kJoint && s.from > r.from + kJoint &&
             std::abs(profile.height(r, s.from) - profile.height(s, s.from)) <= kSameLevel &&
             profile.levels[r.level].normal.dot(profile.levels[s.level].normal) >= kSameSlope;
    });
    if (before == result.end()) {
      result.push_back(s);
      continue;
    }
    if (s.to - s.from > before->to - before->from) before->level = s.level;
    before->to = std::max(before->to, s.to);
  }
  return result;
}

}  // namespace

std::vector<WalkLevel> levels_of(const World& world, const Upright& upright, double max_slope) {
  std::vector<WalkLevel> levels;
  for (std::size_t i = 0; i < world.surfaces.size(); ++i) {
    const Surface& s = world.surfaces[i];
    if (upright.normals[i].z() < std::cos(max_slope)) continue;
    WalkLevel level{.surface = i, .normal = upright.normals[i], .offset = s.plane.offset};
    const auto add = [&](const Loop& loop) {
      level.rings.emplace_back();
      for (const Vec3& v : upright.ring(loop)) level.rings.back().push_back(v.head<2>());
    };
    add(s.outer);
    for (const Loop& hole : s.holes) add(hole);
    for (const Vec2& p : level.rings[0]) level.box.extend(p);
    levels.push_back(std::move(level));
  }
  return levels;
}

std::pair<double, double> range_along(const WalkLevel& level, const Vec2& direction) {
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const Vec2& p : level.rings[0]) {
    low = std::min(low, direction.dot(p));
    high = std::max(high, direction.dot(p));
  }
  return {low, high};
}

WayAxis axis_over(const WalkLevel& level, const Vec2& along) {
  WayAxis axis{.along = along};
  const auto [low, high] = range_along(level, axis.across());
  axis.width = high - low;
  axis.from = (low + high) / 2 * axis.across() + range_along(level, along).first * along;
  return axis;
}

WayProfile profile_of(const std::vector<WalkLevel>& levels, const WayAxis& axis) {
  WayProfile profile{.levels = levels, .axis = axis, .lines = {}};
  for (std::size_t line = 0; line < kWayLines.size(); ++line) {
    const Vec2 origin = axis.from + (kWayLines[line] - 0.5) * axis.width * axis.across();
    for (std::size_t i = 0; i < levels.size(); ++i)
      add_stretches(levels[i], i, origin, axis.along, profile.lines[line]);
    profile.lines[line] = joined(std::move(profile.lines[line]), profile);
  }
  return profile;
}
}  // namespace scanworld
