// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "labels.h"

namespace scanworld::rival {

// What lies on a floor, as carpets do, is that floor: planes that are no farther than this [m] off
// a larger level one, and for the most part surrounded by it, and what is of no plane there, beside
// it, and so on. The planes stay, without points.
LabelledPoints spread_floors(const PointCloud& cloud, const Grid& grid, const Neighbors& neighbors,
                             LabelledPoints labelled, const Vec3& up, double tolerance);

}  // namespace scanworld::rival
