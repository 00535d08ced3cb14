// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Parts of measured surfaces where nothing was measured: behind furniture, under the scanner.
#pragma once

#include "world.h"

namespace scanworld {

// Whether a place in the plane of a surface was inferred.
bool is_inferred(const Surface& surface, const Vec3& place);

// [m2] of all inferred surfaces and parts.
double inferred_area(const World& world);

// Leaves out all surfaces and parts that were inferred. What is left of a surface in several pieces
// has new ids but for the first of them. Returns whether there were any.
bool cut_inferred(World& world);

}  // namespace scanworld
