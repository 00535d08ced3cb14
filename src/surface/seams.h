// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cut_line.h"
#include "patch.h"

namespace scanworld::surface {

struct SeamOptions {
  double min_sine = 0.17;    // of the angle between planes that can meet (10 degrees) ...
  double fold_sine = 0.004;  // ... and of the facets of one that bends, each on a side of its own
  double gap = 0.15;         // [m] patches meet in a line if both come so near to it ...
  double min_length = 0.09;  // [m] ... over this length
  double extension = 0.3;    // [m] a seam may cut so far beyond
};

// Where two patches meet.
struct Seam {
  int a = 0, b = 0;  // a < b
  Line3 line;
  std::vector<Interval> seen;  // [m] ascending: where both come near
  std::vector<Interval> sure;  // those where both reach it, but for the cell next to it
};

inline std::size_t count_of(const std::vector<Seam>& seams) { return seams.size(); }

std::vector<Seam> find_seams(const std::vector<Patch>& patches, const SeamOptions& options = {});

}  // namespace scanworld::surface
