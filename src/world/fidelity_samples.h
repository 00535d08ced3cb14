// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The part of a scan and of a world that is looked at, where fidelity is measured.
#pragma once

#include <vector>

#include "cloud_in_world.h"

namespace scanworld {

// About `wanted` points of the cloud by their indices, chosen and ordered by their coordinates.
std::vector<std::uint32_t> sample_points(const CloudInWorld& cloud, std::size_t wanted);

// A place on a surface, which stands for some area.
struct PlaceOnSurface {
  Vec3 at;
  std::size_t surface;
  double area;  // [m2]
};

// About `wanted` places spread evenly over the measured surfaces, at least so many on each, but
// none in their inferred parts: at equal steps of area through a surface's triangles one after the
// other, in each by a sequence that fills it evenly (Roberts 2018, R2).
std::vector<PlaceOnSurface> sample_surfaces(const World& world, std::size_t wanted,
                                            std::size_t each);

}  // namespace scanworld
