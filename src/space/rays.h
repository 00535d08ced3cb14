// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cover.h"

namespace scanworld::space {

struct RayOptions {
  double site = 0.09;          // [m] of the places in a cube of this size one line of sight ends at
  std::size_t most = 250'000;  // lines of sight; of more, so many by chance
  double before = 0.08;      // [m] a line ends so far before what was seen, or four times the noise
  double min_length = 0.3;   // [m]
  double min_cosine = 0.03;  // to the normal of what was seen
  double on_plane = 3;       // weight of a line to a plane for each m2 that it stands for ...
  double loose = 1;          // ... and of one to anything else
  double mutual = 0.5;       // and of one between patches, where no viewpoint is known
  double far = 12;           // [m] that patches are looked for
};

// A way that nothing stands in.
struct Ray {
  Vec3 from, to;
  int own = -1;       // the patch whose plane it begins or ends at, and does not cross
  double weight = 0;  // [m2]
  bool from_viewpoint = false;
};

// The lines of sight to what is around, from where it was seen; where nothing is known of that,
// those between patches that face each other. In no order that the points' order changes.
std::vector<Ray> find_rays(const surface::Surroundings& around,
                           const std::vector<std::int32_t>& viewers,
                           const std::vector<Cover>& covers, const surface::PatchRays& patches,
                           double noise, const RayOptions& options = {});

// The cells of this size that rays cross.
CellSet crossed_by(const std::vector<Ray>& rays, double cell);

}  // namespace scanworld::space
