// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "../types.h"

namespace scanworld::geos {

// A polygon in the plane: the outer ring first, then its holes; orientation does not matter.
using Rings = std::vector<std::vector<Vec2>>;

// Why the rings are no valid polygon (crossing edges, a hole outside ...) and where; nothing where
// they are one.
std::optional<std::string> why_invalid(const Rings& rings);

// The corners of the triangles of a constrained Delaunay triangulation of a valid polygon, each
// counter-clockwise; nothing where the library fails.
std::optional<std::vector<std::array<Vec2, 3>>> triangulate(const Rings& rings);

}  // namespace scanworld::geos
