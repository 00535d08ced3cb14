// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "evidence.h"

namespace scanworld::space {

// Prices in m2 of what one pays for.
struct LabelOptions {
  double front = 1;              // for each m2 with points that what is before it is not free ...
  double back = 2;               // ... that what is behind it is not solid
  double supported = 0.01;       // for each m2 of a surface with points ...
  double reversed = 0.6;         // ... the wrong way round
  double empty = 1.2;            // ... where points should be
  double beside = 0.045;         // ... beside points ...
  double extended = 0.135;       // ... and more, as far as it is from them
  double bare = 0.35;            // ... of a plane without points ...
  double bare_facet = 0.008;     // ... and for each facet of it, however small
  double of_plate = 0.1;         // ... but the back of a plate
  double open = 0.4;             // for each m2 between free and unknown, where a plane goes on ...
  double open_floor = 1;         // ... a floor, ...
  double open_over_floor = 0.6;  // ... free over unknown, above where a room's floor goes on, ...
  double open_bare = 0.25;       // ... and elsewhere
  double border = 0.25;          // ... and at the border of the whole, ...
  double border_crossed = 0.01;  // ... where lines of sight go
  double volume = 0.2;           // for each m3 of free space that no line of sight crosses
  double min_volume = 0.05;      // [m3] of free space with no viewpoint in it; less is none
  double slit_width = 0.01;      // [m] of a gap in what is solid; what is narrower is none ...
  double slit_solid = 0.6;       // ... where so much of what is around it is solid
  int rounds = 4;                // at most, of cuts
};

enum class Label : std::uint8_t { free, solid, unknown };

// What becomes of space that is unknown.
enum class Unknown : std::uint8_t {
  behind,  // solid behind surfaces, open elsewhere
  solid,   // solid: open sides are closed by surfaces that were not measured
  free,    // free: what is solid has surfaces, not measured, also where it ends at unknown space
  open     // neither: it has no surfaces, and nothing of it is behind one
};

// What each cell is. A surface is between free and solid, an open side between free and unknown;
// between solid and unknown there is nothing to pay.
std::vector<Label> label_cells(const CellComplex& cells, const Evidence& evidence,
                               const LabelOptions& options = {});

// Labels that surfaces are read off, and those that tell how deep it is solid behind them.
std::vector<Label> labels_of_surfaces(std::vector<Label> labels, Unknown unknown);
std::vector<Label> labels_behind(std::vector<Label> labels, Unknown unknown);

// Makes solid the cells that are slits in what is solid: over a door, where the lintel's edges are
// a few millimetres apart on the two sides of the wall.
std::vector<Label> fill_slits(const CellComplex& cells, const Evidence& evidence,
                              std::vector<Label> labels, const LabelOptions& options = {});

// Makes solid what is free, but too small to be in, if no viewpoint is in it.
std::vector<Label> fill_pockets(const CellComplex& cells, const Evidence& evidence,
                                std::vector<Label> labels, const LabelOptions& options = {});

// [m2] The price of a facet between a free cell and one that is solid or unknown, where the free
// one is on its side 0 or 1.
double price_of(const CellFacet& facet, const FacetEvidence& evidence, std::size_t free_side,
                Label other, const LabelOptions& options = {});

}  // namespace scanworld::space
