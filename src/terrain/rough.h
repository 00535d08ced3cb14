// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "facets.h"

namespace scanworld::terrain {

// The cells of ground without the pieces that need more facets than `most` [1/m2], by the cells
// that were seen: stairs, stands, heaps. With `in_parts` the parts of such pieces that do not need
// so many stay. Where cells are larger than 10 cm, as many facets a cell may be needed.
surface::Raster without_rough(const surface::Raster& ground, const surface::Raster& seen,
                              const std::vector<Facet>& facets, double most, bool in_parts);

}  // namespace scanworld::terrain
