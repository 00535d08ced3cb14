// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "neighbors.h"

#include <algorithm>

#include "../parallel.h"

namespace scanworld::rival {

namespace {

// Appends the neighbours of site i to a list.
void add_neighbors(const Grid& grid, std::size_t i, const NeighborOptions& options,
                   const std::vector<std::uint8_t>& only, std::vector<std::uint32_t>& list) {
  const std::int32_t separator = grid.separator.empty() ? -1 : grid.separator[i];
  const Plane* const between =
      separator < 0 ? nullptr : &grid.separators[static_cast<std::size_t>(separator)];
  const auto is_before = [&](std::size_t j) {
    return between->signed_distance(grid.sites[j].position()) > 0;
  };
  const bool own_side = between && is_before(i);
  const std::size_t start = list.size();
  int points = 0;
  const auto is_enough = [&] {
    return points >= options.min_points &&
           list.size() >= start + static_cast<std::size_t>(options.min_sites);
  };
  for (int reach = 1; reach <= options.max_reach && !is_enough(); ++reach) {
    const auto add = [&](std::uint32_t j) {
      if (!only.empty() && !only[j]) return;
      if (between && is_before(j) != own_side) return;
      points += static_cast<int>(grid.sites[j].points);
      list.push_back(j);
    };
    grid.for_each_near(i, reach, add, reach > 1 ? reach - 1 : -1);
  }
}

std::size_t site_count(const Neighbors& neighbors) {
  std::size_t count = 0;
  for (const Neighbors::Part& part : neighbors.parts) count += part.first.size() - 1;
  return count;
}

// Makes the lists of a part of the sites, by add(site, list).
template <typename Add>
Neighbors::Part make_part(const Part& range, const Add& add) {
  Neighbors::Part part;
  std::vector<std::uint32_t> list;
  part.first = {0};
  list.reserve(16 * (range.end - range.begin));
  part.first.reserve(range.end - range.begin + 1);
  for (std::size_t i = range.begin; i < range.end; ++i) {
    add(i, list);
    part.first.push_back(static_cast<std::uint32_t>(list.size()));
  }
  part.sites.assign(list.begin(), list.end());  // without the room that `list` has grown
  return part;
}

}  // namespace

Neighbors find_neighbors(const Grid& grid, const NeighborOptions& options,
                         const std::vector<std::uint8_t>& only) {
  const std::size_t count = grid.sites.size();
  Neighbors result;
  result.parts.resize(part_count(count, Neighbors::kPart));
  parallel_for(result.parts.size(), [&](std::size_t p) {
    result.parts[p] =
        make_part(part_of(p, count, Neighbors::kPart), [&](std::size_t i, auto& list) {
          if (only.empty() || only[i]) add_neighbors(grid, i, options, only, list);
        });
  });
  return result;
}

Neighbors update_neighbors(const Grid& grid, const NeighborOptions& options, Neighbors before,
                           std::vector<std::uint8_t>& changed) {
  changed.assign(grid.sites.size(), 0);
  if (grid.separators.empty()) return before;
  for (std::size_t i = 0; i < grid.sites.size(); ++i) {
    if (grid.separator[i] >= 0) changed[i] = 1;
    if (grid.twin[i] >= 0)
      grid.for_each_near(i, options.max_reach, [&](std::uint32_t j) { changed[j] = 1; });
  }
  const std::size_t count = grid.sites.size(), old = site_count(before);
  Neighbors result;
  result.parts.resize(part_count(count, Neighbors::kPart));
  parallel_for(result.parts.size(), [&](std::size_t p) {
    const auto [begin, end] = part_of(p, count, Neighbors::kPart);
    const auto is_changed = [](std::uint8_t c) { return c != 0; };
    const bool is_same =
        end <= old && std::none_of(changed.begin() + static_cast<long>(begin),
                                   changed.begin() + static_cast<long>(end), is_changed);
    result.parts[p] = is_same ? std::move(before.parts[p])
                              : make_part({begin, end}, [&](std::size_t i, auto& list) {
                                  if (changed[i]) return add_neighbors(grid, i, options, {}, list);
                                  const auto same = before.of(i);
                                  list.insert(list.end(), same.begin(), same.end());
                                });
    if (p < before.parts.size()) before.parts[p] = {};
  });
  return result;
}

}  // namespace scanworld::rival
