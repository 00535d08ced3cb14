// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Parts of measured surfaces where nothing was measured: behind furniture, under the scanner.
#pragma once

#include "geos.h"
#include "world.h"

namespace scanworld {

// The inferred parts of a surface in a frame of its plane.
std::vector<geos::Rings> inferred_rings(const Surface& surface, const PlaneFrame& frame);

// [m2] of all inferred surfaces and parts.
double inferred_area(const World& world);

// Leaves out all surfaces and parts that were inferred. What is left of a surface in several pieces
// has new ids but for the first of them. Returns whether there were any.
bool cut_inferred(World& world);

}  // namespace scanworld
