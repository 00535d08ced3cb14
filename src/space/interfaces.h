// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "label_cells.h"

namespace scanworld::space {

struct InterfaceOptions {
  double max_empty = 0.5;  // share of a facet where points should be; with more it is an opening
  double same = 0.0009;    // [m] corners nearer than this are one; `validate` lets 1 mm pass
  double narrow = 0.005;   // [m] openings are no narrower, nor is what hangs beside a surface alone
  double min_area = 1e-6;  // [m2] of what is shown
  bool is_closed = false;  // whether space ends at the box's border
};

// A surface between free and solid: facets of one plane that hang together.
struct Interface {
  int plane = 0;            // of the complex
  bool is_flipped = false;  // the free side is behind that
  std::vector<std::vector<Vec3>>
      loops;                       // counter-clockwise seen from the free side; holes clockwise
  double area = 0, supported = 0;  // [m2]
  std::vector<int> facets;
};

inline std::size_t count_of(const std::vector<Interface>& interfaces) { return interfaces.size(); }

// The surfaces of labelled cells. Where two of them meet they have the same corners.
std::vector<Interface> find_interfaces(const CellComplex& cells, const Evidence& evidence,
                                       const std::vector<Label>& labels,
                                       const InterfaceOptions& options = {});

}  // namespace scanworld::space
