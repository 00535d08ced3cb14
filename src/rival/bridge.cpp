// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "bridge.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "../cell_walk.h"
#include "../polygon.h"
#include "crossing.h"
#include "join.h"

namespace scanworld::rival {

namespace {

constexpr double kParallel = 0.9;        // cosine between the normals of planes that may be one
constexpr std::size_t kMostEnds = 400;   // sites of a cluster that ways to another go from
constexpr double kNearlyShortest = 1.5;  // times the shortest way: those that tell what is between
constexpr double kParting = 0.6;  // by so much more of one cluster than of the other is on one side
                                  // of what goes between them
constexpr double kHidden = 2;     // [voxels] what is hidden is wider
constexpr double kHiding = 1;     // [m] from a gap to what hides what is there
constexpr double kNever = 1e9;    // a price

// The clusters in each cell of a scan.
class ClusterCells {
 public:
  ClusterCells(const Grid& grid, const Clustering& c) : edge_(3 * grid.voxel) {
    for (std::size_t i = 0; i < grid.sites.size(); ++i)
      if (const Vec3 p = grid.sites[i].position(); has_code(p, edge_))
        clusters_.emplace_back(morton_of(cell_of(p, edge_)), c.label[i]);
    std::sort(clusters_.begin(), clusters_.end());
    clusters_.erase(std::unique(clusters_.begin(), clusters_.end()), clusters_.end());
  }

  double edge() const { return edge_; }

  // Whether any cluster in the cell of a place, or kNone where sites are in none, is such.
  template <typename IsSuch>
  bool any_at(const Vec3& p, const IsSuch& is_such) const {
    if (!has_code(p, edge_)) return false;
    const std::uint64_t code = morton_of(cell_of(p, edge_));
    auto at = std::lower_bound(clusters_.begin(), clusters_.end(), std::pair(code, kNone));
    for (; at != clusters_.end() && at->first == code; ++at)
      if (is_such(at->second)) return true;
    return false;
  }

 private:
  double edge_;                                                   // [m]
  std::vector<std::pair<std::uint64_t, std::int32_t>> clusters_;  // by cell
};

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

// The shortest way from a place in one cluster to another cluster.
struct Link {
  float square;  // [m2] of its length
  Vec3f from, to;

  double length() const { return std::sqrt(square); }
  Vec3 middle() const { return (from + to).cast<double>() / 2; }
};

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

// Two clusters that may be one, and the shortest way between them.
struct Gap {
  double price;  // of their being one; 1 or more is too much
  std::size_t a, b;
  Vec3 middle;

  bool operator<(const Gap& o) const { return std::tie(price, a, b) < std::tie(o.price, o.a, o.b); }
};

class GapFinder {
 public:
  GapFinder(const Grid& grid, const Clustering& c, double max_gap, double hidden_from,
            double open_share)
      : grid_(grid),
        c_(c),
        max_gap_(max_gap),
        hidden_from_(hidden_from),
        open_share_(open_share),
        members_(members_of(c)),
        boxes_(members_.size()),
        cells_(grid, c) {
    for (std::size_t k = 0; k < members_.size(); ++k)
      for (const std::uint32_t i : members_[k]) boxes_[k].extend(grid.sites[i].position());
  }

  // The open gaps between clusters whose price is low enough, the lowest first.
  template <typename PriceOf>
  std::vector<Gap> find(const PriceOf& price_of) const {
    std::vector<Gap> gaps;
    for (std::size_t a = 0; a < members_.size(); ++a)
      for (std::size_t b = a + 1; b < members_.size(); ++b)
        if (const Gap gap = gap_of(a, b, price_of); gap.price < 1) gaps.push_back(gap);
    std::sort(gaps.begin(), gaps.end());
    return gaps;
  }

 private:
  template <typename PriceOf>
  Gap gap_of(std::size_t a, std::size_t b, const PriceOf& price_of) const {
    Gap gap{kNever, a, b, Vec3::Zero()};
    const Cluster &p = c_.clusters[a], &q = c_.clusters[b];
    const Box3 near_a = grown(boxes_[a], max_gap_), near_b = grown(boxes_[b], max_gap_);
    if (members_[a].empty() || members_[b].empty() || !near_a.intersects(boxes_[b]) ||
        std::abs(p.fit.plane.normal.dot(q.fit.plane.normal)) < kParallel)
      return gap;
    const std::vector<Vec3f> from = ends_in(near_b, grid_, members_[a]),
                             to = ends_in(near_a, grid_, members_[b]);
    const std::vector<Link> links = find_links(from, to);
    if (links.empty() || !(links[0].length() <= max_gap_)) return gap;
    gap.middle = links[0].middle();
    const double price = price_of(p, q, gap.middle);
    if (price < 1 && is_open(a, b, from, to, links)) gap.price = price;
    return gap;
  }

  // Whether nothing goes through most of the shortest ways.
  bool is_open(std::size_t a, std::size_t b, const std::vector<Vec3f>& from,
               const std::vector<Vec3f>& to, const std::vector<Link>& links) const {
    const Plane& own = c_.clusters[a].fit.plane;
    std::map<std::int32_t, bool> known;
    const auto parts = [&](std::int32_t l) {
      if (l == kNone || static_cast<std::size_t>(l) == a || static_cast<std::size_t>(l) == b)
        return false;
      const auto [at, is_new] = known.try_emplace(l, false);
      if (is_new)
        at->second =
            is_across(c_.plane(l), own) &&
            std::abs(share_before(c_.plane(l), from) - share_before(c_.plane(l), to)) > kParting;
      return at->second;
    };
    const double longest = kNearlyShortest * std::max(links[0].length(), grid_.voxel);
    double open = 0, all = 0;
    for (const Link& link : links) {
      if (link.length() > longest) break;
      ++all;
      open += !is_crossed(link, own.normal, parts) &&
              (link.length() <= hidden_from_ || is_hidden(link, own.normal));
    }
    return open >= open_share_ * all;
  }

  static double share_before(const Plane& plane, const std::vector<Vec3f>& places) {
    const auto before = std::ranges::count_if(
        places, [&](const Vec3f& p) { return plane.signed_distance(p.cast<double>()) > 0; });
    return static_cast<double>(before) / static_cast<double>(places.size());
  }

  // Whether something is before or behind the middle of a way, which may hide what is there.
  bool is_hidden(const Link& link, const Vec3& normal) const {
    const auto is_any = [](std::int32_t) { return true; };
    const int steps = static_cast<int>(kHiding / cells_.edge());
    for (int k = 1; k <= steps; ++k)
      for (const double side : {-1.0, 1.0})
        if (cells_.any_at(link.middle() + side * k * cells_.edge() * normal, is_any)) return true;
    return false;
  }

  // Whether a cluster that parts two is at the way between them, or close before or behind it.
  template <typename Parts>
  bool is_crossed(const Link& link, const Vec3& normal, const Parts& parts) const {
    const Vec3 from = link.from.cast<double>(), way = (link.to - link.from).cast<double>();
    const int steps = static_cast<int>(2 * link.length() / cells_.edge()) + 1;
    for (int k = 0; k <= steps; ++k)
      for (const double side : {-1.0, 0.0, 1.0})
        if (cells_.any_at(from + way * k / steps + side * cells_.edge() * normal, parts))
          return true;
    return false;
  }

  const Grid& grid_;
  const Clustering& c_;
  const double max_gap_, hidden_from_, open_share_;
  const std::vector<std::vector<std::uint32_t>> members_;
  std::vector<Box3> boxes_;  // of their sites
  const ClusterCells cells_;
};

// Joins clusters across gaps as long as the price of what they have become is low enough.
template <typename PriceOf>
Clustering join_across(const std::vector<Gap>& gaps, const Grid& grid, Clustering c,
                       const PriceOf& price_of) {
  Joiner joiner(std::move(c));
  for (const Gap& gap : gaps)
    if (joiner.find(gap.a) != joiner.find(gap.b) &&
        price_of(joiner.whole(gap.a), joiner.whole(gap.b), gap.middle) < 1)
      joiner.join(gap.a, gap.b);
  return joiner.finish(grid);
}

}  // namespace

Clustering bridge_clusters(const Grid& grid, const Scale& scale, Clustering c,
                           const BridgeOptions& options) {
  const auto price = [&](const Cluster& a, const Cluster& b, const Vec3&) {
    return joint_price(a, b, scale, options.max_rms, Meeting::apart);
  };
  const std::vector<Gap> gaps =
      GapFinder(grid, c, options.max_gap * grid.voxel, INFINITY, options.open_share).find(price);
  return join_across(gaps, grid, std::move(c), price);
}

Clustering bridge_pieces(const Grid& grid, Clustering c, const BridgeOptions& options) {
  const double parallel = std::cos(options.max_angle);
  const auto price = [&](const Cluster& a, const Cluster& b, const Vec3& middle) {
    const Plane &p = a.fit.plane, &q = b.fit.plane;
    const double cosine = p.normal.dot(q.normal), side = cosine < 0 ? -1 : 1;
    if (std::abs(cosine) < parallel) return kNever;
    return std::abs(p.signed_distance(middle) - side * q.signed_distance(middle)) /
           options.max_step;
  };
  const std::vector<Gap> gaps =
      GapFinder(grid, c, options.piece_gap, kHidden * grid.voxel, options.open_share).find(price);
  return join_across(gaps, grid, std::move(c), price);
}

}  // namespace scanworld::rival
