// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace scanworld {

// A way for a flow. Whole numbers make a cut exact: Capacity is double or std::int64_t.
template <typename Capacity>
struct FlowEdge {
  int from, to;
  Capacity capacity, back;  // from -> to, to -> from
};

// For each node whether it is on the source's side of the least cut that parts source and sink
// (Boykov and Kolmogorov 2004).
template <typename Capacity>
std::vector<char> min_cut(std::size_t nodes, int source, int sink,
                          const std::vector<FlowEdge<Capacity>>& edges);

}  // namespace scanworld
