// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../types.h"

namespace scanworld {

// A plane of a place that speaks for what is up there.
struct Facing {
  Vec3 normal;        // unit, to either side
  double weight = 0;  // how much was seen of it, 0 or more: its area, or its points
  Vec3 middle = Vec3::Zero();  // a place of it, by which the floor is told from the ceiling
};

struct UpOptions {
  double max_angle = 0.44;      // [rad] from the axis to up (25 degrees)
  double tolerance = 0.035;     // [rad] off level or upright of planes that speak for an up (2
                                // degrees, which slopes are not), at first ...
  double max_tolerance = 0.11;  // [rad] ... and at most: in steps until enough do (6 degrees), as
                                // scans may be warped
  double min_share = 0.6;       // of the weight that must speak for it
  double axis_bonus = 0.5;      // an up at the largest angle needs 1 + this times as much for it as
                                // the axis
  double min_angle = 0.0009;    // [rad] what is nearer to the axis is the axis (0.05 degrees):
                                // buildings are no better
  double max_unlevelled = 0.0175;  // [rad] a scanner that was levelled is off by less (1 degree)
};

struct Up {
  Vec3 direction = Vec3::UnitZ();
  double angle = 0;         // [rad] off the axis, as the planes say
  double share = 0;         // of the weight that speaks for it
  double tolerance = 0;     // [rad] to which it does
  bool is_found = false;    // whether that is enough
  bool is_floors = false;   // whether it is what the floor says, and the rest only nearly
  bool is_partial = false;  // whether only parallel walls tell: along them it is as the axis is
};

// The direction near the axis that most planes are level or upright to: floors and ceilings are
// square to it, walls along it. It is the one with the least sum of weighted angles, so that a
// bowed ceiling or a ramp turns it as little as a few outliers move a median. Of a scanner that was
// not levelled, whose scan may be warped, it is square to the floor if that is near to it: what
// stands on the floor must not slide.
Up find_up(const std::vector<Facing>& facings, const Vec3& axis, const UpOptions& options = {});

}  // namespace scanworld
