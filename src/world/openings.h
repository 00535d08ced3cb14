// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "wall_gaps.h"
#include "world.h"

namespace scanworld {

// A line along which a scanner saw a point.
struct SightLine {
  Vec3 from, to;

  // Where it goes through a plane to end no nearer than `beyond` [m] to that.
  std::optional<Vec3> crossing(const Plane& plane, double beyond) const {
    const double before = plane.signed_distance(from), behind = plane.signed_distance(to);
    if ((before > 0) == (behind > 0) || std::abs(behind) < beyond) return std::nullopt;
    return from + (to - from) * (before / (before - behind));
  }
};

struct OpeningOptions {
  WallGapOptions gaps;
  double min_door_height = 1.7;  // [m] clear; lower ones that begin at the floor count where they
                                 // go through both faces
  double max_door_height = 2.6, max_door_width = 1.6;  // [m] larger ones are passages
  double same = 0.6;          // share of the smaller of two gaps that both have; then they are one
  double max_apart = 0.15;    // [m] of their sides; by more only the larger one's counts
  double max_size = 1;        // [m2] of a gap for each m2 of its face; of a larger one, as within a
                              // casing, ...
  double min_measured = 0.9;  // ... so much of its sides must be measured
  double min_seen = 0.05;  // lines of sight through an opening, of as many as there are places on
                           // as much of the wall
  double shadow_depth = 0.7;  // [m] before a wall, where places hide it ...
  double max_hidden = 0.3;    // ... but no more than this share of an opening that no line of sight
                              // goes through, as a window to the sky ...
  double max_hidden_blind = 0.6;  // ... or, where no viewpoint is known, of one in one face alone
};

// What was seen of a scan.
struct SeenScan {
  std::span<const SightLine> lines;  // where viewpoints are known
  std::span<const Vec3> places;      // with points, as far apart everywhere
};

struct FoundOpenings {
  std::vector<Opening> openings;
  std::vector<Vec3> corners;  // of openings, to come after the world's vertices
};

// The doors, windows and passages of walls: the upright rectangles that both faces of a wall leave
// free, and what stands within its thickness, each told once. It must have been seen: lines of
// sight go through, or nothing stands before it. Its loop is the rectangle in the face that
// leaves most free. Without a scan all gaps are openings.
FoundOpenings find_openings(const World& world, const SeenScan& scan = {},
                            const OpeningOptions& options = {});

}  // namespace scanworld
