// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "arrange.h"
#include "rays.h"

namespace scanworld::space {

struct FacetEvidence {
  double area = 0;  // [m2]
  std::array<double, 2>
      supported{};       // [m2] with points of a plane that looks to its front, its back
  double empty = 0;      // [m2] where points should be
  double extended = 0;   // [m2] beside points, each weighed by how far from them: 0 at them, 1 at 1
                         // m or at the size of what has points
  bool is_bare = true;   // no plane with points is there ...
  int floor = -1;        // the side that a plane with points there looks to, if that is up
  int over_floor = -1;   // of one that is about level, with a room's floor below: its upper side
  bool is_back = false;  // ... but the back of a plate, that lines of sight go behind
};

struct CellEvidence {
  double front = 0, back = 0;  // [m2] of what has points, that the cell is before or behind
  double crossed = 0;          // [m2] of rays
  double start = 0;            // [m2] of those that begin there
  bool has_viewpoint = false;
  double volume = 0;  // [m3]
  double around = 0;  // [m2] of all its facets

  // Whether many lines of sight cross it, 0 to 1: 1 where they stand for so much of its facets.
  static constexpr double kManyRays = 0.03;
  double seen() const { return around > 0 ? std::min(1.0, crossed / (kManyRays * around)) : 0; }
};

// Rays that go from one cell to the next.
struct Passage {
  int from, to;
  double weight;  // [m2]
};

struct Evidence {
  std::vector<FacetEvidence> facets;
  std::vector<CellEvidence> cells;
  std::vector<Passage> passages;  // ascending
};

// What points and rays say of cells and the facets between them.
Evidence find_evidence(const Arrangement& arrangement, const std::vector<SpacePlane>& planes,
                       const std::vector<Cover>& covers, const std::vector<Ray>& rays,
                       const Vec3& up = Vec3::UnitZ());

}  // namespace scanworld::space
