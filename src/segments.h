// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "types.h"

namespace scanworld {

struct Segment {
  Vec3 from, to;
};

// Where two segments are side by side.
struct Stretch {
  double length = 0;  // [m] along the first one
  double width = 0;   // [m] between them, the most
  Vec3 gap;           // from the first to the second, in the middle
};

// Nothing where no point of the second one is beside the first.
std::optional<Stretch> side_by_side(const Segment& s, const Segment& t);

// All pairs of segments, by ascending index and in order, that come nearer to each other than
// `distance`, and others that are not far (those with a cell of a grid in common).
std::vector<std::pair<std::size_t, std::size_t>> near_pairs(const std::vector<Segment>& segments,
                                                            double distance);

}  // namespace scanworld
