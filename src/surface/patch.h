// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "raster.h"

namespace scanworld::surface {

// The points of each plane.
struct Members {
  std::vector<std::uint32_t> points;  // indices into the cloud, plane by plane
  std::vector<std::size_t> first;     // for each plane its first; one more at the end

  std::span<const std::uint32_t> of(std::size_t plane) const {
    return {points.data() + first[plane], first[plane + 1] - first[plane]};
  }
};

// `labels`: for each point of the cloud its plane or -1.
Members group_points(const std::vector<std::int32_t>& labels, std::size_t planes);

struct PatchOptions {
  double margin = 0.25;  // [m] around the points
};

// A plane and where its points are.
struct Patch {
  Plane plane;
  PlaneFrame frame;
  Raster hit;                // cells with points; empty where there are none
  Raster covered;            // those and the gaps of one or two cells between them
  Box3 box;                  // of the points
  std::vector<Vec2> middle;  // of each cell of `hit`; of its points where it has some
  // What each cell says for the surface, more than 0 where it is hit: the area, in cells, that its
  // points stand for where they are sparse. Where it is not hit, down to -1 as points were to be
  // expected.
  std::vector<float> evidence;
};

inline std::size_t count_of(const std::vector<Patch>& patches) { return patches.size(); }

std::vector<Patch> find_patches(const PointCloud& cloud, const Members& members,
                                const std::vector<Plane>& planes, double cell,
                                const PatchOptions& options = {});

}  // namespace scanworld::surface
