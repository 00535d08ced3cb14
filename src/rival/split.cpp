// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "split.h"

#include <algorithm>

#include "../disjoint_sets.h"
#include "../parallel.h"
#include "crossing.h"

namespace scanworld::rival {

namespace {

constexpr std::size_t kPart = 1 << 15;

// Joins neighbouring sites of a cluster unless the plane of one that crosses it is between them.
class Connector {
 public:
  Connector(const Grid& grid, const Neighbors& neighbors, const Clustering& c, int reach)
      : grid_(grid), neighbors_(neighbors), c_(c), reach_(reach), sets_(c.label.size()) {}

  struct Link {
    std::uint32_t from, to;
  };
  // Those within a range of the sites; notes the links that leave it.
  void join_within(const Part& range, std::vector<Link>& leaving) {
    Across across;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (c_.label[i] == kNone) continue;
      for (std::uint32_t j : neighbors_.of(i)) {
        if (c_.label[j] != c_.label[i]) continue;
        const Link link{static_cast<std::uint32_t>(i), j};
        if (j < range.begin || j >= range.end)
          leaving.push_back(link);
        else
          join(link, across);
      }
    }
  }
  void join_all(const std::vector<Link>& links) {
    Across across;
    for (const Link& link : links) join(link, across);
  }
  DisjointSets take() { return std::move(sets_); }

 private:
  // The clusters that go across that of a site around it.
  struct Across {
    std::uint32_t site = ~0u;
    std::vector<std::int32_t> clusters;
  };

  void join(const Link& link, Across& across) {
    // Mostly they are joined already; then there is nothing to test.
    if (sets_.are_joined(link.from, link.to)) return;
    if (across.site != link.from) find_across(link.from, across);
    const Vec3 a = grid_.sites[link.from].position(), b = grid_.sites[link.to].position();
    if (std::none_of(across.clusters.begin(), across.clusters.end(),
                     [&](std::int32_t l) { return is_between(c_.plane(l), a, b); }))
      sets_.unite(link.from, link.to);
  }

  void find_across(std::uint32_t i, Across& across) const {
    across = {i, {}};
    const auto around = neighbors_.of(i);
    // Mostly nothing else is near.
    if (std::none_of(around.begin(), around.end(),
                     [&](std::uint32_t j) { return c_.label[j] != kNone && c_.may_border(j); }))
      return;
    const std::int32_t own = c_.label[i];
    const auto look = [&](std::size_t j) {
      const std::int32_t l = c_.label[j];
      if (l != kNone && l != own && is_across(c_.plane(l), c_.plane(own)))
        add_new(across.clusters, l);
    };
    grid_.for_each_near(i, reach_, look);
    for (std::uint32_t j : around) look(j);
  }

  const Grid& grid_;
  const Neighbors& neighbors_;
  const Clustering& c_;
  const int reach_;
  DisjointSets sets_;
};

// The connected parts of all clusters.
DisjointSets connect(const Grid& grid, const Neighbors& neighbors, const Clustering& c, int reach) {
  Connector connector(grid, neighbors, c, reach);
  std::vector<std::vector<Connector::Link>> leaving(part_count(c.label.size(), kPart));
  parallel_for(leaving.size(), [&](std::size_t part) {
    connector.join_within(part_of(part, c.label.size(), kPart), leaving[part]);
  });
  for (const auto& links : leaving) connector.join_all(links);
  return connector.take();
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
