// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "open_sky.h"
#include "patch_rays.h"

namespace scanworld::surface {

struct FacingOptions {
  int places = 16;       // of a patch that are looked from
  int directions = 16;   // from each place to each side
  double horizon = 4;    // [m] what is farther counts as so far
  double margin = 0.05;  // [m] before a place, where a line of sight may meet something
  double min_lead =
      0.2;  // share of normals, of viewers or of what one sees, that must prefer one side
  double min_way = 1;     // [m] that one sees on average to the side that is clearly free
  double max_behind = 2;  // places seen from behind for each seen from before, of a viewpoint
  SkyOptions sky;         // where normals do not tell
};

// The patch with its normal the other way.
Patch flipped(const Patch& patch);

// Patches whose normals point to the free side, and what of the viewpoints helped.
struct Faced {
  std::vector<Patch> patches;
  std::vector<Vec3> viewpoints;      // those of the cloud from where it can have been seen
  std::vector<std::int32_t> number;  // of each of the cloud's viewpoints its index there, or -1
};

// Turns the patches' normals to the free side: as most normals of the points, those that are set;
// where there are none, to the side with more free space before other patches. On that side one
// looks far before something is met; inside a wall or a cupboard one does not, and outside of what
// was scanned nothing is met at all. Out of doors the ground and the sky tell, see find_turned().
// At last to the viewpoints that have seen most places: those that the points themselves know, if
// enough of them do; there is no stronger evidence. A viewpoint that sees patches
// from behind for the most part, as the zero that was never set does in map coordinates, does not
// count; patches of which nothing else tells the side do not testify against one.
Faced face_free_side(std::vector<Patch> patches, const PatchRays& rays, const PointCloud& cloud,
                     const Members& members, const Vec3& up, const FacingOptions& options = {});

}  // namespace scanworld::surface
