// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut_line.h"
#include "seen_through.h"

namespace scanworld::surface {

struct GapOptions {
  double shadow_depth = 0.7;      // [m] what stands no farther before a patch hides it ...
  double shadow_cosine = 0.5;     // ... unless it is a plane at a larger angle to it
  double level = 0.9;             // cosine off upright of patches that one stands on
  double depth_below = 3;         // [m] so far something below them counts
  double hidden_evidence = 0.02;  // of cells without points that something hides
  double hidden_share = 0.4;      // of a gap's cells; then all of it counts as hidden
  double max_tilt = 0.05;         // [rad] between the two faces of a wall ...
  double max_thickness = 0.6;     // [m] ... and between them
  double open_evidence = -0.1;    // of a place and what is around it, in an opening of that face
  SeenThroughOptions through;
  double ground_price = 0.12;  // of cells of a floor without points, where nothing is below; 1 for
                               // others
};

// Weighs the cells without points anew, once it is known where the patches meet: those that were
// seen through, those that something hides, but not where the other face of the wall has an
// opening, those of a gap that is hidden for the most part, as seen from where the scanner may have
// been, and those of a floor that nothing is below. Beyond where a patch meets others, and beyond
// its own points, nothing changes.
std::vector<Patch> weigh_gaps(std::vector<Patch> patches,
                              const std::vector<std::vector<CutLine>>& lines,
                              const Surroundings& around, const Vec3& up,
                              const GapOptions& options = {});

}  // namespace scanworld::surface
