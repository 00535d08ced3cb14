// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "open_gaps.h"

#include <algorithm>
#include <map>

#include "../cell_walk.h"
#include "../polygon.h"
#include "crossing.h"

namespace scanworld::rival {

namespace {

constexpr double kNearlyParallel = 0.9;  // cosine between the normals of planes that may be one
constexpr std::size_t kMostEnds = 400;   // sites of a cluster that ways to another go from
constexpr double kNearlyShortest = 1.5;  // times the shortest way: those that tell what is between
constexpr double kParting = 0.6;  // by so much more of one cluster than of the other is on one side
                                  // of what goes between them
constexpr double kHiding = 1;     // [m] from a gap to what hides what is there

// A cluster's sites that are in a box; where they are many, some of them.
std::vector<Vec3f> ends_in(const Box3& box, const Grid& grid,
                           const std::vector<std::uint32_t>& sites) {
  std::vector<Vec3f> all, some;
  for (const std::uint32_t i : sites)
    if (box.contains(grid.sites[i].position())) all.push_back(grid.sites[i].mean);
  const std::size_t step = (all.size() + kMostEnds - 1) / kMostEnds;
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

std::vector<Link> find_links(const std::vector<Vec3f>& from, const std::vector<Vec3f>& to) {
  std::vector<Link> links;
  for (const Vec3f& a : from) {
    Link best{INFINITY, a, a};
    for (const Vec3f& b : to)
      if (const float square = (b - a).squaredNorm(); square < best.square) best = {square, a, b};
    links.push_back(best);
  }
  std::ranges::stable_sort(links, {}, &Link::square);
  return links;
}

double share_before(const Plane& plane, const std::vector<Vec3f>& places) {
  const auto before = std::ranges::count_if(
      places, [&](const Vec3f& p) { return plane.signed_distance(p.cast<double>()) > 0; });
  return static_cast<double>(before) / static_cast<double>(places.size());
}

// Whether a cluster that parts two is at the way between them, or close before or behind it.
bool is_crossed(const Link& link, const Vec3& normal, const ClusterCells& cells,
                const std::function<bool(std::int32_t)>& parts) {
  const Vec3 from = link.from.cast<double>(), way = (link.to - link.from).cast<double>();
  const int steps = static_cast<int>(2 * link.length() / cells.edge()) + 1;
  for (int k = 0; k <= steps; ++k)
    for (const double side : {-1.0, 0.0, 1.0})
      if (cells.any_at(from + way * k / steps + side * cells.edge() * normal, parts)) return true;
  return false;
}

// Whether something is before or behind the middle of a way, which may hide what is there.
bool is_hidden(const Link& link, const Vec3& normal, const ClusterCells& cells) {
  const auto is_any = [](std::int32_t) { return true; };
  const int steps = static_cast<int>(kHiding / cells.edge());
  for (int k = 1; k <= steps; ++k)
    for (const double side : {-1.0, 1.0})
      if (cells.any_at(link.middle() + side * k * cells.edge() * normal, is_any)) return true;
  return false;
}

}  // namespace

ClusterCells::ClusterCells(const Grid& grid, const Clustering& c) : edge_(3 * grid.voxel) {
  for (std::size_t i = 0; i < grid.sites.size(); ++i) {
    const Vec3 p = grid.sites[i].position();
    if (!has_code(p, edge_)) continue;
    const std::pair entry(morton_of(cell_of(p, edge_)), c.label[i]);
    if (clusters_.empty() || clusters_.back() != entry) clusters_.push_back(entry);
  }
  std::sort(clusters_.begin(), clusters_.end());
  clusters_.erase(std::unique(clusters_.begin(), clusters_.end()), clusters_.end());
}

bool ClusterCells::any_at(const Vec3& p, const std::function<bool(std::int32_t)>& is_such) const {
  if (!has_code(p, edge_)) return false;
  const std::uint64_t code = morton_of(cell_of(p, edge_));
  auto at = std::lower_bound(clusters_.begin(), clusters_.end(), std::pair(code, kNone));
  for (; at != clusters_.end() && at->first == code; ++at)
    if (is_such(at->second)) return true;
  return false;
}

// What there is between two clusters: some of their sites near each other, and the ways from those
// of the one to the other, the shortest first; none where they are too far apart.
struct GapFinder::Ways {
  std::size_t a, b;
  std::vector<Vec3f> from, to;
  std::vector<Link> links;
};

GapFinder::GapFinder(const Grid& grid, const Clustering& c, const GapOptions& options)
    : grid_(grid), c_(c), options_(options), members_(members_of(c)), boxes_(members_.size()) {
  for (std::size_t k = 0; k < members_.size(); ++k)
    for (const std::uint32_t i : members_[k]) boxes_[k].extend(grid.sites[i].position());
}

const ClusterCells& GapFinder::cells() const {
  if (!cells_) cells_.emplace(grid_, c_);
  return *cells_;
}

std::vector<Gap> GapFinder::find(const GapPrice& price_of) const {
  std::vector<Gap> gaps;
  for (std::size_t a = 0; a < members_.size(); ++a)
    for (std::size_t b = a + 1; b < members_.size(); ++b) {
      const Ways ways = find_ways(a, b);
      if (ways.links.empty()) continue;
      const Vec3 middle = ways.links[0].middle();
      const double price = price_of(c_.clusters[a], c_.clusters[b], middle);
      if (price < 1 && are_open(ways)) gaps.push_back({price, a, b, middle});
    }
  std::sort(gaps.begin(), gaps.end());
  return gaps;
}

bool GapFinder::is_open(std::size_t a, std::size_t b) const {
  const Ways ways = find_ways(a, b);
  return !ways.links.empty() && are_open(ways);
}

GapFinder::Ways GapFinder::find_ways(std::size_t a, std::size_t b) const {
  Ways ways{a, b, {}, {}, {}};
  const Vec3 &p = c_.clusters[a].fit.plane.normal, &q = c_.clusters[b].fit.plane.normal;
  const Box3 near_a = grown(boxes_[a], options_.max_gap),
             near_b = grown(boxes_[b], options_.max_gap);
  if (members_[a].empty() || members_[b].empty() || !near_a.intersects(boxes_[b]) ||
      std::abs(p.dot(q)) < kNearlyParallel)
    return ways;
  ways.from = ends_in(near_b, grid_, members_[a]), ways.to = ends_in(near_a, grid_, members_[b]);
  if (ways.to.empty()) return ways;
  ways.links = find_links(ways.from, ways.to);
  if (!ways.links.empty() && ways.links[0].length() > options_.max_gap) ways.links.clear();
  return ways;
}

// Whether nothing goes through most of the shortest ways.
bool GapFinder::are_open(const Ways& ways) const {
  const Plane& own = c_.clusters[ways.a].fit.plane;
  std::map<std::int32_t, bool> known;
  const auto parts = [&](std::int32_t l) {
    if (l == kNone || static_cast<std::size_t>(l) == ways.a ||
        static_cast<std::size_t>(l) == ways.b)
      return false;
    const auto [at, is_new] = known.try_emplace(l, false);
    const Plane& plane = c_.plane(l);
    if (is_new && is_across(plane, own))
      at->second =
          std::abs(share_before(plane, ways.from) - share_before(plane, ways.to)) > kParting;
    return at->second;
  };
  const double longest = kNearlyShortest * std::max(ways.links[0].length(), grid_.voxel);
  double open = 0, all = 0;
  for (const Link& link : ways.links) {
    if (link.length() > longest) break;
    ++all;
    open += !is_crossed(link, own.normal, cells(), parts) &&
            (link.length() <= options_.hidden_from || is_hidden(link, own.normal, cells()));
  }
  return open >= options_.open_share * all;
}

}  // namespace scanworld::rival
