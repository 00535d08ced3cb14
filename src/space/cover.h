// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../surface/seams.h"
#include "sight.h"

namespace scanworld::space {

struct CoverOptions {
  double reach_share = 0.7;  // of a patch's size, the root of its area: so far it may go on ...
  double min_reach = 0.3;    // [m] ... but at least
  double max_reach = 0.8;    // [m] ... and at most
  double floor_reach = 4;    // [m] the same of a floor in a room: under all that hides it
  SightOptions sight;
};

// What the scan says of a plane cell by cell, also beyond where its points are.
struct Cover {
  Plane plane;
  PlaneFrame frame;
  surface::Raster supported;    // cells with points, and gaps of one or two between them
  std::vector<float> empty;     // 0 to 1: how sure it is that there is no surface: points should be
                                // there, and nothing hides it
  std::vector<float> distance;  // [m] from what is supported, by ways that no other surface blocks;
                                // kBlocked where there is none
  double area = 0;              // [m2] that is supported
  double reach = 0;             // [m] so far it may go on
  bool is_room_floor = false;   // it looks up, and ceilings are over a part of it

  std::vector<float> stands_for;  // [cells] the area that the points in a cell stand for, or 0

  static constexpr float kBlocked = 1e9F;

  bool is_none() const { return area == 0; }
  // [m2] that the points at a place stand for, more than a cell where they are sparse.
  double area_of_point(const Vec3& place) const {
    const auto at = supported.find(frame.to_plane(place));
    return at ? stands_for[*at] * supported.cell * supported.cell : 0;
  }
};

// One for each patch. The patches' evidence is what their points say alone; a plane does not go on
// through the seams where others stand on it.
std::vector<Cover> find_covers(const std::vector<surface::Patch>& patches,
                               const std::vector<surface::Seam>& seams, const Sight& sight,
                               const CoverOptions& options = {});

}  // namespace scanworld::space
