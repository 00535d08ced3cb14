// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "leaves.h"

#include <algorithm>
#include <cmath>

namespace scanworld {

namespace {

constexpr double kMostTilt = 0.1;  // cosine of a leaf's normal to up, at most

// What stands upright, seen from above: from end to end along a level direction.
struct Stand {
  Vec3 along = Vec3::Zero(), from = Vec3::Zero(), to = Vec3::Zero();
  double low = 0, high = 0;  // [m] along up

  double width() const { return (to - from).norm(); }
};

Stand stand_of(const World& world, const Loop& loop, const Vec3& normal) {
  const Vec3& up = world.frame.up;
  Stand stand{.along = up.cross(normal).normalized()};
  double first = std::numeric_limits<double>::max(), last = -first;
  stand.low = first, stand.high = last;
  Vec3 middle = Vec3::Zero();
  for (const int v : loop) {
    const Vec3& p = world.vertices[static_cast<std::size_t>(v)];
    first = std::min(first, stand.along.dot(p)), last = std::max(last, stand.along.dot(p));
    stand.low = std::min(stand.low, up.dot(p)), stand.high = std::max(stand.high, up.dot(p));
    middle += p / static_cast<double>(loop.size());
  }
  const Vec3 foot = middle - up.dot(middle) * up - stand.along.dot(middle) * stand.along;
  stand.from = foot + first * stand.along, stand.to = foot + last * stand.along;
  return stand;
}

// How a stand hangs in an opening as its leaf; nothing where it does not.
std::optional<Leaf> hung_in(const Stand& opening, const Vec3& front, const Stand& stand,
                            const LeafOptions& options) {
  const double off = options.max_off;
  const double width = opening.width(), height = opening.high - opening.low;
  if (std::abs(stand.width() - width) > off * width) return std::nullopt;
  if (std::abs(stand.low - opening.low) > off * height || stand.high < opening.high - off * height)
    return std::nullopt;
  std::optional<Leaf> best;
  double nearest = std::numeric_limits<double>::max();
  for (const bool at_start : {true, false}) {
    const Vec3& side = at_start ? opening.from : opening.to;
    const Vec3 closed = at_start ? opening.along : Vec3(-opening.along);
    for (const bool is_turned : {true, false}) {
      const Vec3& hinge = is_turned ? stand.to : stand.from;
      const Vec3 leaf = is_turned ? Vec3(-stand.along) : stand.along;
      const double aside = std::abs(closed.dot(hinge - side));
      const double depth = std::abs(front.dot(hinge - side));
      const double angle = std::acos(std::clamp(closed.dot(leaf), -1.0, 1.0));
      if (aside > options.max_aside || depth > options.max_depth || angle < options.min_angle ||
          aside + depth >= nearest)
        continue;
      nearest = aside + depth;
      // Who looks at the front has the direction of up x front to the right.
      best = Leaf{.angle = angle,
                  .hinge = at_start ? LeafHinge::left : LeafHinge::right,
                  .opens_to = leaf.dot(front) > 0 ? LeafSide::front : LeafSide::back};
    }
  }
  return best;
}

}  // namespace

std::vector<Opening> hang_leaves(const World& world, const LeafOptions& options) {
  const Vec3& up = world.frame.up;
  struct Candidate {
    const Surface* surface;
    Stand stand;
  };
  std::vector<Candidate> candidates;
  for (const Surface& s : world.surfaces)
    if (s.source == Source::measured && std::abs(s.plane.normal.dot(up)) < kMostTilt &&
        s.thickness && *s.thickness <= options.max_thickness)
      candidates.push_back({&s, stand_of(world, s.outer, s.plane.normal)});
  std::vector<Opening> openings = world.openings;
  for (Opening& o : openings) {
    o.leaf.reset();
    const Surface* wall = find_surface(world, o.surface);
    if (o.kind == OpeningKind::window || !wall) continue;
    const Stand opening = stand_of(world, o.loop, wall->plane.normal);
    const Vec3 front = opening.along.cross(up);
    std::size_t most = 0;
    for (const Candidate& c : candidates) {
      if (c.surface == wall || c.surface->support.points <= most) continue;
      if (auto leaf = hung_in(opening, front, c.stand, options)) {
        leaf->surface = c.surface->id;
        o.leaf = leaf, most = c.surface->support.points;
      }
    }
  }
  return openings;
}

OptionList list_options(LeafOptions& o) {
  return {
      {"leaves.max_thickness", &o.max_thickness, "m", "of a door's leaf", 0},
      {"leaves.max_off", &o.max_off, "", "of the opening's width and height that a leaf's are off",
       0, 1},
      {"leaves.max_aside", &o.max_aside, "m", "from the opening's side to the leaf's hinge", 0},
      {"leaves.max_depth", &o.max_depth, "m", "the same through the wall", 0},
      {"leaves.min_angle", &o.min_angle, "rad", "from closed", 0},
  };
}

}  // namespace scanworld
