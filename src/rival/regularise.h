// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cluster.h"
#include "scale.h"

namespace scanworld::rival {

struct RegulariseOptions {
  double max_angle = 0.02;  // [rad] planes that differ by less may be parallel or square
  double max_rise = 6;  // of a plane's chi-square, by turning it (95 % of chance's, 2 degrees of
                        // freedom, is 6)
  double max_shift = 0.002;  // [m] at a plane's edge by turning it, beside its own uncertainty and
                             // what surfaces of its extent bend
  double max_offset = 3;     // [standard deviations] parallel planes nearer than this are one plane
  double max_step = 1.5;  // [noise and bend] a plane that is nowhere farther off a larger one ...
  double max_crack = 0.005;  // [m] ... nor than this, and no farther away ...
  double max_gap = 0.15;     // [m] ... than this, takes the larger one's plane
};

// Makes planes parallel, square and coplanar where their points do not object: nothing is turned
// that chance would not have turned as far. And parts of one wall that are a hair's breadth off
// each other get one plane, as corners cannot close such a crack.
Clustering regularise(const Scale& scale, Clustering clustering,
                      const RegulariseOptions& options = {});

}  // namespace scanworld::rival
