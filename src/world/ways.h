// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../options.h"
#include "upright.h"
#include "world.h"

namespace scanworld {

struct WayOptions {
  double min_width = 0.4;                     // [m]
  double min_riser = 0.08, max_riser = 0.25;  // [m] from one tread to the next
  double min_tread = 0.15, max_tread = 0.5;   // [m] the same in plan
  // [m] twice the riser and the tread, as long as a pace (F. Blondel, Cours d'architecture, 1675).
  double min_pace = 0.5, max_pace = 0.8;
  int min_steps = 3;                          // risers of stairs; fewer are a step or two
  double min_slope = 0.05, max_slope = 0.35;  // [rad] of a ramp; less is a floor, more a roof
  double min_rise = 0.1;                      // [m] of a ramp
  double min_floor = 0.5;                     // [m] deep is a floor or a landing
};

OptionList list_options(WayOptions& options);

// Stairs, a straight flight each, and ramps, from the lowest.
// A flight is treads one above and behind the other, all by the same riser and tread: at most six
// after each other may be missing, as where nothing was seen of them. It begins or ends, or both,
// at a floor or a landing. A ramp is a sloping surface with floors at its foot and at its top.
// Rooms are not told (find_rooms() does). Ground that no plane fits is no ramp. Spiral stairs and
// winders are not found.
std::vector<Way> find_ways(const World& world, const Upright& upright,
                           const WayOptions& options = {});

}  // namespace scanworld
