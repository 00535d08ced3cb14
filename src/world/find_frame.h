// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "world.h"

namespace scanworld {

// The frame of a scan in which these surfaces were found, with what was assumed. Up is +Z, but for
// the image of a camera, in whose frame y points down: a camera is pitched as it likes, so there
// the largest surface that faces roughly against its y axis tells what is level.
Frame find_frame(const PointCloud& cloud, const std::vector<FoundSurface>& surfaces);

}  // namespace scanworld
