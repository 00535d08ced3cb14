// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "split.h"

#include <algorithm>

#include "../parallel.h"
#include "crossing.h"
#include "disjoint_sets.h"

namespace scanworld::rival {

namespace {

constexpr std::size_t kPart = 1 << 12;

// Whether each site has one of another cluster among its neighbours, or is next to one that has.
std::vector<char> find_border(const Neighbors& neighbors, const Clustering& c) {
  std::vector<char> near(c.label.size());
  parallel_for(part_count(near.size(), kPart), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, near.size(), kPart);
    for (std::size_t i = begin; i < end; ++i) {
      const auto around = neighbors.of(i);
      near[i] =
          c.label[i] != kNone && std::any_of(around.begin(), around.end(), [&](std::uint32_t j) {
            return c.label[j] != kNone && c.may_border(j);
          });
    }
  });
  return near;
}

// The clusters that go across that of a site around it.
void find_across(const Grid& grid, const Neighbors& neighbors, const Clustering& c, std::size_t i,
                 int reach, std::vector<std::int32_t>& across) {
  across.clear();
  const std::int32_t own = c.label[i];
  const auto look = [&](std::size_t j) {
    const std::int32_t l = c.label[j];
    if (l != kNone && l != own && is_across(c.plane(l), c.plane(own))) add_new(across, l);
  };
  grid.for_each_near(i, reach, look);
  for (std::uint32_t j : neighbors.of(i)) look(j);
}

// The connected parts of all clusters.
DisjointSets connect(const Grid& grid, const Neighbors& neighbors, const Clustering& c, int reach) {
  const std::vector<char> near_border = find_border(neighbors, c);
  DisjointSets parts(c.label.size());
  std::vector<std::int32_t> across;
  for (std::size_t i = 0; i < c.label.size(); ++i) {
    if (c.label[i] == kNone) continue;
    bool looked = false;
    for (std::uint32_t j : neighbors.of(i)) {
      // Mostly they are in one part already; then there is nothing to test.
      if (c.label[j] != c.label[i] || parts.find(i) == parts.find(j)) continue;
      if (near_border[i]) {
        if (!looked) find_across(grid, neighbors, c, i, reach, across), looked = true;
        if (std::any_of(across.begin(), across.end(), [&](std::int32_t l) {
              return is_between(c.plane(l), grid.sites[i].position(), grid.sites[j].position());
            }))
          continue;
      }
      parts.unite(i, j);
    }
  }
  return parts;
}

}  // namespace

Clustering split_clusters(const Grid& grid, const Neighbors& neighbors, Clustering c,
                          const SplitOptions& options) {
  DisjointSets parts = connect(grid, neighbors, c, options.reach);
  const std::size_t count = c.label.size();
  std::vector<double> points(count);
  for (std::size_t i = 0; i < count; ++i)
    if (c.label[i] != kNone) points[parts.find(i)] += grid.sites[i].points;
  // The first large part of a cluster keeps its label, each further one gets a new one, small
  // parts go to none. A cluster without a large part stays as it is.
  std::vector<std::int32_t> label_of(count, kNone);
  std::vector<char> has_large(c.clusters.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (points[i] < options.min_points) continue;
    const auto l = static_cast<std::size_t>(c.label[i]);
    if (has_large[l]) {
      label_of[i] = static_cast<std::int32_t>(c.clusters.size());
      c.clusters.push_back(c.clusters[l]);
    } else {
      label_of[i] = c.label[i];
      has_large[l] = 1;
    }
  }
  for (std::size_t i = 0; i < count; ++i)
    if (c.label[i] != kNone && has_large[static_cast<std::size_t>(c.label[i])])
      c.relabel(i, label_of[parts.find(i)]);
  refit(grid, c);
  return c;
}

}  // namespace scanworld::rival
