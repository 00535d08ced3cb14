// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "find_up.h"
#include "world.h"

namespace scanworld {

// What surfaces say about up, by the area of them that was seen.
std::vector<Facing> facings_of(const std::vector<FoundSurface>& surfaces);

// The frame of a scan in which planes with these facings were found, with what was assumed. Up is
// +Z, or near it where floors, ceilings and walls tell so. The image of a camera is in the camera's
// frame, where y points down; as a camera is pitched as it likes, up is up to 50 degrees off -Y.
Frame find_frame(const PointCloud& cloud, const std::vector<Facing>& facings);

}  // namespace scanworld
