// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "face_slabs.h"

namespace scanworld {

// The slabs of all floors: one box for those of one height where nothing free is in it, else as few
// as can be joined. Free is what another surface shows from its front, and places off the floors
// from where one looks down on something.
std::vector<Slab> floor_slabs(const World& world, const std::vector<Face>& faces,
                              const FaceDepths& depths, const Clearance& clearance,
                              const SlabOptions& options);

}  // namespace scanworld
