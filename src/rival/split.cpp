// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "split.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../parallel.h"

namespace scanworld::rival {

namespace {

constexpr std::size_t kPart = 1 << 12;
constexpr double kMaxCosine = 0.7;  // between the normals of planes that cross (45 degrees)

}  // namespace

Clustering split_clusters(const Grid& grid, const Neighbors& neighbors, Clustering c,
                          const SplitOptions& options) {
  const std::size_t count = grid.sites.size();
  std::vector<std::uint32_t> to(count);
  std::iota(to.begin(), to.end(), 0u);
  const auto find = [&](std::uint32_t i) {
    while (to[i] != i) i = to[i] = to[to[i]];
    return i;
  };
  std::vector<char> near_border(count);
  parallel_for(part_count(count, kPart), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, count, kPart);
    for (std::size_t i = begin; i < end; ++i) {
      const auto around = neighbors.of(i);
      near_border[i] =
          c.label[i] != kNone && std::any_of(around.begin(), around.end(), [&](std::uint32_t j) {
            return c.label[j] != kNone && c.may_border(j);
          });
    }
  });
  // The clusters at an angle to that of site i which are around it.
  std::vector<std::int32_t> crossing;
  const auto find_crossing = [&](std::size_t i) {
    crossing.clear();
    if (!near_border[i]) return;
    const Vec3 normal = c.plane(c.label[i]).normal;
    const auto look = [&](std::size_t j) {
      const std::int32_t l = c.label[j];
      if (l != kNone && l != c.label[i] &&
          std::find(crossing.begin(), crossing.end(), l) == crossing.end() &&
          std::abs(c.plane(l).normal.dot(normal)) < kMaxCosine)
        crossing.push_back(l);
    };
    grid.for_each_near(i, options.reach, look);
    for (std::uint32_t j : neighbors.of(i)) look(j);
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (c.label[i] == kNone) continue;
    bool looked = false;
    for (std::uint32_t j : neighbors.of(i)) {
      // Mostly they are in one part already; then there is nothing to test.
      if (c.label[j] != c.label[i] || find(static_cast<std::uint32_t>(i)) == find(j)) continue;
      if (!looked) find_crossing(i), looked = true;
      const bool apart = std::any_of(crossing.begin(), crossing.end(), [&](std::int32_t l) {
        return c.plane(l).signed_distance(grid.sites[i].position()) *
                   c.plane(l).signed_distance(grid.sites[j].position()) <
               0;
      });
      if (apart) continue;
      const std::uint32_t a = find(static_cast<std::uint32_t>(i)), b = find(j);
      to[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<double> points(count);
  for (std::size_t i = 0; i < count; ++i)
    if (c.label[i] != kNone) points[find(static_cast<std::uint32_t>(i))] += grid.sites[i].points;
  // A cluster without a large part stays as it is; small parts of the others go to none.
  std::vector<int> large_parts(c.clusters.size());
  for (std::size_t i = 0; i < count; ++i)
    if (points[i] >= options.min_points) ++large_parts[static_cast<std::size_t>(c.label[i])];
  std::vector<std::int32_t> label_of(count, kNone);
  std::vector<char> taken(c.clusters.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (points[i] < options.min_points) continue;
    const auto l = static_cast<std::size_t>(c.label[i]);
    if (!taken[l]) {
      taken[l] = 1;
      label_of[i] = static_cast<std::int32_t>(l);
    } else {
      label_of[i] = static_cast<std::int32_t>(c.clusters.size());
      c.clusters.push_back(c.clusters[l]);
    }
  }
  for (std::size_t i = 0; i < count; ++i)
    if (c.label[i] != kNone && large_parts[static_cast<std::size_t>(c.label[i])] > 0) {
      const std::int32_t l = label_of[find(static_cast<std::uint32_t>(i))];
      if (l != c.label[i]) c.label[i] = l, c.awake[i] = 1;
    }
  refit(grid, c);
  return c;
}

}  // namespace scanworld::rival
