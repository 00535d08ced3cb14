// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "neighbors.h"

#include <algorithm>

#include "../parallel.h"

namespace scanworld::rival {

Neighbors find_neighbors(const Grid& grid, const NeighborOptions& options,
                         const std::vector<std::uint8_t>& only) {
  const std::size_t count = grid.sites.size();
  Neighbors result;
  result.parts.resize(part_count(count, Neighbors::kPart));
  parallel_for(result.parts.size(), [&](std::size_t p) {
    const auto [begin, end] = part_of(p, count, Neighbors::kPart);
    std::vector<std::uint32_t>& first = result.parts[p].first;
    std::vector<std::uint32_t> list;
    if (only.empty()) list.reserve(16 * (end - begin));
    first = {0};
    first.reserve(end - begin + 1);
    for (std::size_t i = begin; i < end; ++i) {
      const int max_reach = only.empty() || only[i] ? options.max_reach : 0;
      for (int reach = 1; reach <= max_reach; ++reach) {
        list.resize(first.back());
        int points = 0;
        grid.for_each_near(i, reach, [&](std::uint32_t j) {
          if (!only.empty() && !only[j]) return;
          points += static_cast<int>(grid.sites[j].points);
          list.push_back(j);
        });
        if (points >= options.min_points) break;
      }
      first.push_back(static_cast<std::uint32_t>(list.size()));
    }
    result.parts[p].sites.assign(list.begin(), list.end());
  });
  return result;
}

}  // namespace scanworld::rival
