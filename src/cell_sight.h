// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>

#include "cell_set.h"
#include "types.h"

namespace scanworld {

constexpr auto kNobody = std::numeric_limits<std::size_t>::max();

// What the points of a cell know of who saw them.
struct OwnViewer {
  std::int32_t viewer = -1;  // index of the viewpoint of most of them
  bool is_alone = false;     // a single point, which may be a stray that no ray met
};

// Those of some cells, by ascending code; empty where the points do not know any.
std::vector<OwnViewer> own_viewers(const PointCloud& cloud, std::span<const std::uint64_t> codes,
                                   double cell);

// The viewpoint that each of some cells with points was seen from: its own where there is one, else
// the only one; of many the nearest one, of the four nearest, that no opaque cell hides it from,
// beyond those that it adjoins; kNobody where there is none. A stray must not be hidden from its
// own either. `cell` [m] is the edge of one. Where cells have their own, a single viewpoint has not
// seen all others.
std::vector<std::size_t> find_viewers(std::span<const std::uint64_t> codes,
                                      const std::vector<Vec3>& viewpoints, double cell,
                                      const CellSet& opaque, std::span<const OwnViewer> own = {});

}  // namespace scanworld
