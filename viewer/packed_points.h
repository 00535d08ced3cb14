// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "types.h"

namespace scanworld {

// A box as the page reads it: {min, max}.
nlohmann::ordered_json box_json(const Box3& box);

// Coordinates as whole numbers of 65535ths of a box, x y z of each point, as the page reads them
// (docs/page.md). Points outside are put on its border.
std::vector<std::uint16_t> pack(const std::vector<Vec3>& points, const Box3& box);

}  // namespace scanworld
