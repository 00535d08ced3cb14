// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "floor_slabs.h"

namespace scanworld {

struct ColliderOptions {
  SlabOptions slabs;
  ClearanceOptions clearance;
  double ground_depth = 0.5;  // [m] of ground that no plane fits
};

// Solids for a physics engine behind all surfaces, docs/colliders.md: few, boxes wherever possible,
// off free space, overlapping inside so that nothing slips through. Surfaces that are no valid
// polygons get none. What thickness is known must be set before (set_thickness).
std::vector<Collider> make_colliders(const World& world, const ColliderOptions& options = {});

OptionList list_options(ColliderOptions& options);

}  // namespace scanworld
