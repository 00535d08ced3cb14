// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "../types.h"

namespace scanworld::surface {

// An edge of an outline, from vertex to vertex; what it bounds is to its left.
struct HalfEdge {
  int from, to;
  int tag = 0;  // what the caller knows it by
};

// The loops that edges make, by their indices, after those that are walked both ways have cancelled
// each other. As many edges must come to each vertex as leave it. Where a loop could touch itself
// in a vertex, it falls into two there: each goes around one thing.
std::vector<std::vector<std::size_t>> trace_loops(const std::vector<HalfEdge>& edges,
                                                  const std::function<Vec2(int)>& at);

}  // namespace scanworld::surface
