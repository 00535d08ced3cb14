// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "../noise_map.h"
#include "world.h"

namespace scanworld {

// The lengths of a scan that clutter is looked at in [m].
struct ClutterScale {
  double noise = 0.01;    // standard deviation of the points off their surface
  double spacing = 0.02;  // between neighbouring points on a surface
  NoiseMap local = {};    // where there is more noise
};

struct ClutterOptions {
  double cell_per_spacing = 2;    // the edge of the cells in which neighbours are looked for
  double cell_per_noise = 4;      // and at least so many times the noise
  double min_cell = 0.04;         // [m] nor is it smaller
  double surface_distance = 4;    // [noise] points no farther from a surface are not clutter
  double min_density = 0.25;      // points in a place where the scan's spacing leads to expect one
  double min_own_density = 0.08;  // and where the middle of the same thing has one
  int min_points = 40;            // of a thing that stands or hangs on a surface
  int min_floating_points = 200;  // of one that touches none
  double min_size = 0.1;          // [m] its longest extent
};

// Points that no surface explains, thinned: one in each cube of half a cell.
struct Clutter {
  double cell = 0;                 // [m]
  std::vector<Vec3> points;        // thing by thing, each in an order of its own cubes
  std::vector<std::size_t> first;  // for each thing its first point; one more at the end

  std::size_t things() const { return first.empty() ? 0 : first.size() - 1; }
  std::span<const Vec3> of(std::size_t thing) const {
    return {points.data() + first[thing], first[thing + 1] - first[thing]};
  }
};

// The things that stand in a world: connected points without a surface (`labels`: -1), where they
// are as dense as a surface is. What is left of a surface's noise, stray points and the curtains
// between an edge and what is behind it are not.
Clutter find_clutter(const PointCloud& cloud, const std::vector<std::int32_t>& labels,
                     const World& world, const ClutterScale& scale,
                     const ClutterOptions& options = {});

}  // namespace scanworld
