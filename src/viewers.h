// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "types.h"

namespace scanworld {

// The viewpoint that most of some points around a place were seen from, of equal ones the nearest
// to it; -1 where it is known of none. `viewers` are theirs, by index or -1, and get sorted: the
// order of points or viewpoints does not matter.
std::int32_t main_viewer(std::vector<std::int32_t>& viewers, const std::vector<Vec3>& viewpoints,
                         const Vec3& place);

}  // namespace scanworld
