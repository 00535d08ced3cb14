// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grid.h"

namespace scanworld::rival {

struct NeighborOptions {
  int min_points = 12;  // a neighbourhood grows until it holds so many
  int min_sites = 6;    // in so many voxels, as a single scan line is no neighbourhood
  int max_reach = 3;    // [voxels] but no farther
};

// The sites around each site, itself included: a cube of voxels that is larger where points are
// sparse, so that what is looked at follows the density of the scan.
struct Neighbors {
  static constexpr std::size_t kPart = 1 << 9;  // sites are kept in parts of so many

  struct Part {
    std::vector<std::uint32_t> first;  // for each site its first entry in `sites`; one more at the
                                       // end
    std::vector<std::uint32_t> sites;
  };
  std::vector<Part> parts;

  std::span<const std::uint32_t> of(std::size_t site) const {
    const Part& part = parts[site / kPart];
    const std::uint32_t* const first = part.first.data() + site % kPart;
    return {part.sites.data() + first[0], first[1] - first[0]};
  }
};

inline std::size_t count_of(const Neighbors& neighbors) {
  std::size_t count = 0;
  for (const auto& part : neighbors.parts) count += part.sites.size();
  return count;
}

// Where two sides of a wall are around a site, its neighbours are on its own side. `only`: where
// not empty, sites that it does not mark have no neighbours and are none.
Neighbors find_neighbors(const Grid& grid, const NeighborOptions& options = {},
                         const std::vector<std::uint8_t>& only = {});

// The neighbours after sides were parted: lists in which nothing has changed are those of `before`.
// Marks the sites whose neighbours are new.
Neighbors update_neighbors(const Grid& grid, const NeighborOptions& options, Neighbors before,
                           std::vector<std::uint8_t>& changed);

}  // namespace scanworld::rival
