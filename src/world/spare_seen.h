// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "fit_solid.h"
#include "seen_space.h"

namespace scanworld {

struct SpareSeenOptions {
  double depth = 0.05;      // [m] in a solid, from where space that was seen to be free is wrong
  double min_free = 2e-3;   // [m3] less of it is let pass
  double min_share = 0.02;  // of the solid's volume; nor does less of it count
  double max_deep = 0.1;    // of the points, more than a cell deep in a solid that nobody saw into
  double min_filled = 0.9;  // of the cells of each layer of a box, with points
  int min_points = 3;       // thinned ones that no other box holds
};

// How much of a solid around some points is free [m3]: what was seen to be, deep in it. Where it is
// thinner than two cells, all that is farther than one from its points is, as it has no inside that
// nobody could see. Where no viewpoint is known, a solid with many points deep in it is no solid.
double free_volume(const Solid& solid, const Frame& frame, std::span<const Vec3> points,
                   const SeenSpace& seen, const SpareSeenOptions& options = {});

// Whether so little of a solid around some points is free that it may be kept.
bool spares_free(const Solid& solid, const Frame& frame, std::span<const Vec3> points,
                 const SeenSpace& seen, const SpareSeenOptions& options = {});

// Few upright boxes that hold points and little else: cells with points, in the axes of their plan,
// are joined to boxes, which may overlap and end where their points do. `cell` [m]: points no
// farther from each other are neighbours on a surface. The smallest boxes may be left out.
std::vector<OrientedBox> cover_by_boxes(std::span<const Vec3> points, const Vec3& up, double cell,
                                        double noise, const SpareSeenOptions& options = {});

}  // namespace scanworld
