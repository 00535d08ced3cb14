// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "patch.h"
#include "weld.h"

namespace scanworld::surface {

// Cells of a raster whose middles are in a polygon, and how many of them are set.
struct CellsInside {
  std::size_t all = 0, set = 0;
};
CellsInside count_cells(const Raster& raster, const PlaneFrame& frame, const Piece& piece);

// Each polygon as a surface, with what the scan says of it: its support and its colour. Those in
// planes that come after the patches' are inferred.
std::vector<FoundSurface> describe(const PointCloud& cloud, const Members& members,
                                   const std::vector<Patch>& patches,
                                   const std::vector<Plane>& planes,
                                   const std::vector<Piece>& pieces);

}  // namespace scanworld::surface
