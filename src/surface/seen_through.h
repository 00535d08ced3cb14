// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "patch_rays.h"
#include "surroundings.h"

namespace scanworld::surface {

struct SeenThroughOptions {
  double margin = 0.05;     // [m] before a place, where its line of sight may meet something
  double behind = 0.15;     // [m] off a patch's plane; nearer places tell nothing of it
  double min_cosine = 0.2;  // of the angle of a line to the normal of what it goes through
  int lines = 2;            // through a cell and the eight around it
  int most = 400'000;       // places that are looked at, when there are several viewpoints
};

// The viewpoint of each place around, or -1: its own where any place knows one (`around.viewers`),
// else the only one of those nearby that has a free line to it. Where several may have seen it,
// none of their lines proves that there is nothing in it.
std::vector<std::int32_t> find_sole_viewers(const Surroundings& around, const PatchRays& rays,
                                            const std::vector<Vec3>& viewpoints,
                                            const SeenThroughOptions& options = {});

// The cells of a patch that lines of sight to what is behind it go through.
Raster seen_through(const Patch& patch, const Surroundings& around,
                    const SeenThroughOptions& options = {});

}  // namespace scanworld::surface
