// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "cells.h"

namespace scanworld::space {

using Edge = std::pair<int, int>;  // from one corner to another

// The outlines of some facets of a complex, cut at the corners of all of them: where two facets
// meet they have the same edges.
class FacetEdges {
 public:
  // Vertices nearer than `same` [m] are one corner.
  FacetEdges(const CellComplex& cells, const std::vector<int>& facets, double same);

  // Calls visit(from, to) for the corners along the outline of a facet, one of those.
  template <typename Visit>
  void visit(int facet, const Visit& visit) const {
    const CellFacet& own = cells_.facets()[static_cast<std::size_t>(facet)];
    for (std::size_t i = 0; i < own.vertices.size(); ++i) {
      const std::vector<int>& on = lines_.at(line_of(own.plane, own.edge_planes[i]));
      const auto from = std::find(on.begin(), on.end(), own.vertices[i]),
                 to = std::find(on.begin(), on.end(), own.vertices[(i + 1) % own.vertices.size()]);
      const std::ptrdiff_t step = from < to ? 1 : -1;
      for (auto at = from; at != to; at += step) {
        const int a = corner_[static_cast<std::size_t>(*at)],
                  b = corner_[static_cast<std::size_t>(*(at + step))];
        if (a != b) visit(a, b);
      }
    }
  }

 private:
  static std::uint64_t line_of(int plane, int other) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(std::min(plane, other))) << 32 |
           static_cast<std::uint32_t>(std::max(plane, other));
  }

  const CellComplex& cells_;
  std::vector<int> corner_;  // that stands for each vertex
  // All vertices of the facets on each line that two planes have in common, in order.
  std::unordered_map<std::uint64_t, std::vector<int>> lines_;
};

}  // namespace scanworld::space
