// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "facet_edges.h"
#include "label_cells.h"

namespace scanworld::space {

// Of a facet between free and solid: 0 where the cell before it is free, 1 where that behind it is.
inline std::size_t free_side_of(const CellFacet& facet, const std::vector<Label>& labels) {
  const int before = facet.cells[0];
  return before >= 0 && labels[static_cast<std::size_t>(before)] == Label::free ? 0 : 1;
}

// Facets of one plane with the same side free that share edges, together.
std::vector<std::vector<int>> find_sheets(const CellComplex& cells,
                                          const std::vector<Label>& labels, const FacetEdges& edges,
                                          const std::vector<int>& facets);

// Facets between free and solid: those that are surfaces, and those of openings.
struct FacetsBetween {
  std::vector<int> surfaces, openings;
};

// The facets that are shown, in order: those of surfaces, but of sheets narrower than `narrow` [m],
// also in openings, those with which much less of the edges is open. A slit between two surfaces is
// closed, a fringe beside one is taken away.
std::vector<int> close_slits(const CellComplex& cells, const std::vector<Label>& labels,
                             const FacetEdges& edges, const FacetsBetween& facets, double narrow);

}  // namespace scanworld::space
