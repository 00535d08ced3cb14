// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../world/openings.h"
#include "flats.h"

namespace scanworld::terrain {

// The known cells that one looks down through: where five lines of sight or more pass below, that
// end lower than the ground by more than `margin` [m].
surface::Raster seen_through(const Heights& filled, const Level& level,
                             const std::vector<SightLine>& lines, double margin);

// Sets the heights of the cells that are set beyond those that are known, as those lead to expect;
// what nothing can be said of is not set.
Heights filled(const Heights& heights, const surface::Raster& wanted, int reach);

// The set cells that hang together over their sides.
std::vector<std::vector<std::size_t>> pieces_of(const surface::Raster& wanted);

// Of the set cells those in connected pieces with so many that count, and such a share of them.
surface::Raster large_pieces(const surface::Raster& wanted, const surface::Raster& counts,
                             std::size_t least, double least_share);

}  // namespace scanworld::terrain
