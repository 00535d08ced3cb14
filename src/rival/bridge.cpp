// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "bridge.h"

#include <algorithm>
#include <cmath>

#include "crossing.h"
#include "join.h"

namespace scanworld::rival {

namespace {

constexpr double kParallel = 0.9;  // cosine between the normals of planes that may be one

// For each cluster the box of its sites, larger by a gap [m].
std::vector<Box3> reaches_of(const Grid& grid,
                             const std::vector<std::vector<std::uint32_t>>& members, double gap) {
  std::vector<Box3> boxes(members.size());
  for (std::size_t k = 0; k < members.size(); ++k) {
    for (std::uint32_t i : members[k]) boxes[k].extend(grid.sites[i].position());
    if (!boxes[k].isEmpty()) boxes[k] = grown(boxes[k], gap);
  }
  return boxes;
}

struct Link {
  double square;  // [m2] of its length
  std::uint32_t from, to;
};

// For each of the sites the shortest link to a site of cluster `to` within reach.
std::vector<Link> find_links(const Grid& grid, const Clustering& c,
                             const std::vector<std::uint32_t>& sites, std::int32_t to,
                             const Box3& there, int reach) {
  std::vector<Link> links;
  for (std::uint32_t i : sites) {
    const Vec3 here = grid.sites[i].position();
    if (!there.contains(here)) continue;
    Link best{1e30, i, i};
    grid.for_each_near(i, reach, [&](std::uint32_t j) {
      if (c.label[j] != to) return;
      const double square = (grid.sites[j].position() - here).squaredNorm();
      if (square < best.square) best = {square, i, j};
    });
    if (best.to != i) links.push_back(best);
  }
  return links;
}

// Whether the plane of a third cluster that is near one of its ends goes through a link.
bool is_crossed(const Grid& grid, const Clustering& c, const Link& link, int reach) {
  const Vec3 a = grid.sites[link.from].position(), b = grid.sites[link.to].position();
  const Plane& own = c.plane(c.label[link.from]);
  bool crossed = false;
  for (std::uint32_t end : {link.from, link.to})
    grid.for_each_near(end, reach, [&](std::uint32_t j) {
      const std::int32_t l = c.label[j];
      if (crossed || l == kNone || l == c.label[link.from] || l == c.label[link.to]) return;
      const Plane& plane = c.plane(l);
      crossed = is_across(plane, own) && is_between(plane, a, b);
    });
  return crossed;
}

bool is_open(const Grid& grid, const Clustering& c, const std::vector<Link>& links,
             const BridgeOptions& options) {
  if (links.empty()) return false;
  double shortest = 1e30;
  for (const Link& link : links) shortest = std::min(shortest, link.square);
  std::size_t open = 0, all = 0;
  for (const Link& link : links) {
    if (link.square > 2 * shortest) continue;
    ++all;
    open += !is_crossed(grid, c, link, options.reach);
  }
  return static_cast<double>(open) >= options.open_share * static_cast<double>(all);
}

}  // namespace

Clustering bridge_clusters(const Grid& grid, const Scale& scale, Clustering c,
                           const BridgeOptions& options) {
  const std::vector<std::vector<std::uint32_t>> members = members_of(c);
  const std::vector<Box3> reaches = reaches_of(grid, members, options.max_gap * grid.voxel);
  Joiner joiner(std::move(c));
  for (std::size_t a = 0; a < members.size(); ++a)
    for (std::size_t b = a + 1; b < members.size(); ++b) {
      if (!reaches[a].intersects(reaches[b]) || joiner.find(a) == joiner.find(b)) continue;
      const Cluster &p = joiner.whole(a), &q = joiner.whole(b);
      if (std::abs(p.fit.plane.normal.dot(q.fit.plane.normal)) < kParallel ||
          joint_price(p, q, scale, options.max_rms, Meeting::apart) > 1)
        continue;
      const bool from_a = members[a].size() < members[b].size();
      const std::size_t from = from_a ? a : b, other = from_a ? b : a;
      const std::vector<Link> links =
          find_links(grid, joiner.clustering(), members[from], static_cast<std::int32_t>(other),
                     reaches[other], options.max_gap);
      if (is_open(grid, joiner.clustering(), links, options)) joiner.join(a, b);
    }
  return joiner.finish(grid);
}

}  // namespace scanworld::rival
