// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "arrangement.h"

namespace scanworld::surface {

// Prices in m2 of cells with points that are left out.
struct ChoiceOptions {
  double sure_price = 0.0005;  // [m] for an outline along a seam that both patches reach
  double seam_price = 0.01;    // [m] along one that they come near to
  double edge_price = 0.03;    // [m] along an end that the points show
  double open_price = 0.1;     // [m] anywhere else
};

// Which cells are the surface: the choice with the lowest price of all (minimum cut; Boykov and
// Kolmogorov 2004).
std::vector<char> choose_cells(const Arrangement& arrangement, const std::vector<CutLine>& lines,
                               const PlaneFrame& frame, const ChoiceOptions& options = {});

}  // namespace scanworld::surface
