// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "world.h"

namespace scanworld {

struct GlassOptions {
  double share = 0.25;   // of what is as dense as around the window; less is behind glass
  double rim = 0.3;      // [m] around the window, of the wall, to compare with
  double behind = 0.15;  // [m] what is nearer to the wall's plane is not behind it ...
  double depth = 10;     // [m] ... nor what is farther
  double standoff = 2;   // [m] one looks from so far before a window, where no viewpoint is known
};

// Flags the windows behind which hardly anything was seen, though a scanner stood before them: a
// pane gives no returns but a few mirrored ones. So does the open sky; a window is glazed rather.
// `places`: of what the scan holds, as dense on the wall as behind it; these and the viewpoints,
// which may be none, in the world's coordinates. `viewers`: of each place the index of its own
// viewpoint or -1; empty where none is known.
std::vector<Opening> flag_glass(const World& world, std::vector<Opening> openings,
                                const std::vector<Vec3>& places,
                                const std::vector<Vec3>& viewpoints,
                                const std::vector<std::int32_t>& viewers = {},
                                const GlassOptions& options = {});

// The world with one more surface for each pane, after its own: its wall's, but for the loop.
World with_panes(World world);

}  // namespace scanworld
