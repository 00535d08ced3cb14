// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geos.h"

namespace scanworld {

using Rectangle = Eigen::AlignedBox2d;

// A rectangle as a polygon.
geos::Rings rings_of(const Rectangle& rectangle);

struct RectangleOptions {
  double tolerance = 0.001;  // [m] rectangles stick out of what is allowed by no more
  double min_width = 0.02;   // [m] narrower strips need no cover
};

// Rectangles along the axes that together cover what is rectangular in `needed`: the fewest that
// there are, or nearly so where the polygon is large. They may overlap, lie within `allowed`, which
// includes `needed`, and are as large as they can be. What is in one of the polygons `done` needs
// no cover. Parts of `needed` along edges that are oblique by more than the tolerance are left out.
std::vector<Rectangle> cover_with_rectangles(const geos::Rings& needed,
                                             const std::vector<geos::Rings>& allowed,
                                             const std::vector<geos::Rings>& done = {},
                                             const RectangleOptions& options = {});

}  // namespace scanworld
