// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "../types.h"

namespace scanworld {

// True where the points are the pixels of one image of a pinhole camera, `width` in a line, in the
// camera's own frame: x to the right, y down, z ahead. Then column and row of a pixel tell x/z and
// y/z.
bool is_camera_image(const PointCloud& cloud, std::uint64_t width);

}  // namespace scanworld
