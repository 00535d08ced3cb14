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

// Why rings are no valid polygon: crossing edges, a hole outside ...
struct Flaw {
  std::string reason;
  std::optional<Vec2> at;  // where that is known
};

// Nothing where they are one.
std::optional<Flaw> find_flaw(const Rings& rings);

// The same in words.
std::optional<std::string> why_invalid(const Rings& rings);

// The corners of the triangles of a constrained Delaunay triangulation of a valid polygon, each
// counter-clockwise; nothing where the library fails.
std::optional<std::vector<std::array<Vec2, 3>>> triangulate(const Rings& rings);

// What two valid polygons have in common: its area, and a point in it where that is not 0.
struct Overlap {
  double area = 0;
  Vec2 inside = Vec2::Zero();
};
Overlap overlap_of(const Rings& a, const Rings& b);

// The valid polygons that rings stand for, which may cross, touch or lie outside of each other:
// what the outer ring goes around an odd number of times, without what the holes do. Corners stay;
// new ones are where edges cross. Orientation as below.
std::vector<Rings> make_valid(const Rings& rings);

// The union of valid polygons. Here and below, outer rings of results are counter-clockwise, holes
// clockwise; nothing where the library fails.
std::vector<Rings> unite(const std::vector<Rings>& polygons);

// What is left of a valid polygon without others, but for parts narrower than `min_width`.
std::vector<Rings> subtract(const Rings& polygon, const std::vector<Rings>& others,
                            double min_width);

// What each of some valid polygons has in common with others that do not overlap.
std::vector<std::vector<Rings>> intersect(const std::vector<Rings>& polygons,
                                          const std::vector<Rings>& others);

// The Delaunay triangulation of places, each counter-clockwise; nothing where there are no three.
std::vector<std::array<Vec2, 3>> delaunay(const std::vector<Vec2>& places);

}  // namespace scanworld::geos
