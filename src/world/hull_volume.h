// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../types.h"

namespace scanworld {

// The volume of the convex hull of a few dozen points [m3]; 0 where they have none. Face by face,
// without a library: Qhull takes 70 us for 24 points, as it is made for many, and cutting clutter
// asks for thousands of them. It is exact but for rounding, and the same for the same order.
double hull_volume(const std::vector<Vec3>& points);

}  // namespace scanworld
