// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "patch_rays.h"

namespace scanworld::surface {

struct SkyOptions {
  double level = 0.5;       // cosine off upright of ground, roofs and ceilings; steeper is a wall
  double min_lead = 0.3;    // share of a wall's places by which one side must be free more often
  double headroom = 1.8;    // [m] nobody looks at what is lower over a floor from below
  double layers = 0.5;      // [m] what is no higher over a patch is more of it, and hides no sky
  double min_walled = 0.1;  // share of the ways from below a ceiling that meet the walls of a room
};

// Of each patch, as it is turned now: whether it is told by more than rays, and what is free on the
// side that its normal points to and on the other.
struct Outlook {
  bool is_told = false;         // by normals
  std::array<double, 2> way{};  // [m] that one looks, all ways together
  std::array<int, 2> to_sky{};  // ways that go up and meet nothing
  std::vector<Vec3> places;     // on the patch
};

// Which patches look the wrong way, as the ground and the sky tell: what is over ground that was
// seen from above, and has the sky or a ceiling over it, is free. So the walls of a house that was
// scanned from outside look outwards, and those of a room inwards, though one looks about as far to
// their other side. What has the open sky above it looks up, unless it is the ceiling of a room: a
// floor is below, or walls that look to each other.
std::vector<std::uint8_t> find_turned(const std::vector<Patch>& patches,
                                      const std::vector<Outlook>& outlooks, const PatchRays& rays,
                                      const std::vector<Vec3>& directions, const Vec3& up,
                                      double horizon, const SkyOptions& options = {});

}  // namespace scanworld::surface
