// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rough.h"

#include "gaps.h"

namespace scanworld::terrain {

using surface::Raster;

namespace {

// Whether cells that were seen need too many facets.
bool is_rough(std::size_t facets, std::size_t seen, double most) {
  constexpr double kUsual = 0.1;  // [m] edge of a cell
  return static_cast<double>(facets) > most * kUsual * kUsual * static_cast<double>(seen);
}

// The cells of a piece where those around need too many.
std::vector<std::size_t> rough_cells(const std::vector<std::size_t>& piece, const Raster& seen,
                                     const std::vector<std::size_t>& facets_at, double most) {
  constexpr int kAround = 5;  // cells to each side
  Raster own = surface::empty_like(seen);
  for (const std::size_t i : piece) own.bits[i] = 1;
  std::vector<std::size_t> rough;
  for (const std::size_t i : piece) {
    std::size_t count = 0, facets = 0;
    for (int y = seen.row(i) - kAround; y <= seen.row(i) + kAround; ++y)
      for (int x = seen.column(i) - kAround; x <= seen.column(i) + kAround; ++x)
        if (own.is_set(x, y)) {
          const std::size_t k = seen.index(x, y);
          count += seen.bits[k], facets += facets_at[k];
        }
    if (is_rough(facets, count, most)) rough.push_back(i);
  }
  return rough;
}

}  // namespace

Raster without_rough(const Raster& ground, const Raster& seen, const std::vector<Facet>& facets,
                     double most, bool in_parts) {
  std::vector<std::size_t> facets_at(ground.bits.size());  // each in its first cell
  for (const Facet& facet : facets)
    if (!facet.cells.empty()) ++facets_at[facet.cells.front()];
  Raster left = ground;
  for (const std::vector<std::size_t>& piece : pieces_of(ground)) {
    std::size_t count = 0, seen_cells = 0;
    for (const std::size_t i : piece) count += facets_at[i], seen_cells += seen.bits[i];
    if (!is_rough(count, seen_cells, most)) continue;
    for (const std::size_t i : in_parts ? rough_cells(piece, seen, facets_at, most) : piece)
      left.bits[i] = 0;
  }
  return left;
}

}  // namespace scanworld::terrain
