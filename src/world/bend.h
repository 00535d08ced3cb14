// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "ray_scene.h"

namespace scanworld {

struct BendOptions {
  double reach = 0.05;    // [m] of points that are taken for a surface's
  double square = 0.5;    // [m] edge of the squares of a surface whose points are taken together
  double min_points = 5;  // in a square
  std::size_t min_squares = 8;  // of a surface that tells
};

// How far a scan's surfaces are off planes by themselves [m], apart from noise: floors sag, and
// registration bends what is straight. The points of each surface, those that are `nearest` to it,
// are put together in squares, a plane is laid through the squares' means, and what these are off
// it by more than chance is bend; of the surfaces the median by area. Where surfaces lie in the
// world does not matter. 0 where too little was seen.
double measure_bend(const World& world, const std::vector<Vec3>& points,
                    const std::vector<std::optional<Nearest>>& nearest,
                    const BendOptions& options = {});

}  // namespace scanworld
