// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "interfaces.h"

namespace scanworld::space {

struct DepthOptions {
  double max_depth = 0.5;  // [m] so far is looked
  double share = 0.05;     // of the surface's area that may be thinner
};

// [m] How deep it is not free behind a surface, in the middles of its facets and beside their
// corners; at most `max_depth`.
double depth_behind(const CellComplex& cells, const std::vector<Label>& labels,
                    const Interface& surface, const DepthOptions& options = {});

}  // namespace scanworld::space
