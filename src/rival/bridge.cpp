// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "bridge.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scanworld::rival {

namespace {

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
  const Vec3& normal = c.plane(c.label[link.from]).normal;
  bool crossed = false;
  for (std::uint32_t end : {link.from, link.to})
    grid.for_each_near(end, reach, [&](std::uint32_t j) {
      const std::int32_t l = c.label[j];
      if (crossed || l == kNone || l == c.label[link.from] || l == c.label[link.to]) return;
      const Plane& plane = c.plane(l);
      crossed = std::abs(plane.normal.dot(normal)) < 0.7 &&
                plane.signed_distance(a) * plane.signed_distance(b) < 0;
    });
  return crossed;
}

bool is_open(const Grid& grid, const Clustering& c, std::vector<Link> links,
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
  const std::size_t count = c.clusters.size();
  std::vector<std::vector<std::uint32_t>> members(count);
  std::vector<Box3> bounds(count);
  for (std::size_t i = 0; i < c.label.size(); ++i) {
    if (c.label[i] == kNone) continue;
    const auto l = static_cast<std::size_t>(c.label[i]);
    members[l].push_back(static_cast<std::uint32_t>(i));
    bounds[l].extend(grid.sites[i].position());
  }
  const double gap = options.max_gap * grid.voxel;
  for (Box3& box : bounds)
    if (!box.isEmpty()) box = Box3(box.min().array() - gap, box.max().array() + gap);
  std::vector<std::size_t> to(count);
  std::iota(to.begin(), to.end(), std::size_t{0});
  const auto find = [&](std::size_t k) {
    while (to[k] != k) k = to[k];
    return k;
  };
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b) {
      if (!bounds[a].intersects(bounds[b])) continue;
      Cluster &p = c.clusters[find(a)], &q = c.clusters[find(b)];
      if (&p == &q || std::abs(p.fit.plane.normal.dot(q.fit.plane.normal)) < 0.9) continue;
      const MomentFit joint = fit(p.moments + q.moments);
      const double noise = std::max(scale.noise_at(p.fit.centroid), scale.noise_at(q.fit.centroid));
      const double limit = std::pow(options.max_rms * noise, 2);
      if (std::max(p.moments.mean_square(joint.plane), q.moments.mean_square(joint.plane)) > limit)
        continue;
      const bool from_a = members[a].size() < members[b].size();
      const std::size_t from = from_a ? a : b, other = from_a ? b : a;
      if (!is_open(grid, c,
                   find_links(grid, c, members[from], static_cast<std::int32_t>(other),
                              bounds[other], options.max_gap),
                   options))
        continue;
      const std::size_t low = std::min(find(a), find(b)), high = std::max(find(a), find(b));
      c.clusters[low].moments += c.clusters[high].moments;
      c.clusters[low].fit = joint;
      to[high] = low;
    }
  for (std::size_t i = 0; i < c.label.size(); ++i)
    if (c.label[i] != kNone) {
      const auto l = static_cast<std::int32_t>(find(static_cast<std::size_t>(c.label[i])));
      if (l != c.label[i]) c.label[i] = l, c.awake[i] = 1;
    }
  refit(grid, c);
  return c;
}

}  // namespace scanworld::rival
