// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>

#include "cell_set.h"
#include "types.h"

namespace scanworld {

constexpr auto kNobody = std::numeric_limits<std::size_t>::max();

// The viewpoint that each of some cells with points was seen from: the only one; of many the
// nearest one, of the four nearest, that no opaque cell hides it from, beyond those that it
// adjoins; kNobody where there is none. `cell` [m] is the edge of one.
std::vector<std::size_t> find_viewers(std::span<const std::uint64_t> codes,
                                      const std::vector<Vec3>& viewpoints, double cell,
                                      const CellSet& opaque);

}  // namespace scanworld
