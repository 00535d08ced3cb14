// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "round_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "../disjoint_sets.h"
#include "support_points.h"

namespace scanworld {

namespace {

constexpr std::size_t kSeeds = 300;  // in a thing
constexpr std::size_t kSides = 48;   // of an ellipsoid, to tell how many were seen
constexpr double kMaxBias = 0.7;     // [noise] of what a side's points are off on the whole
// What holds a fit back from other shapes than a ball [noise]: while it grows from a few points,
// which bend the ellipsoid as their noise wants, and at the end.
constexpr double kStiff = 10, kSoft = 2;

using Indices = std::vector<std::uint32_t>;

struct RoundCandidate {
  Ellipsoid shape;
  Indices on;  // its points
  bool operator<(const RoundCandidate& o) const { return on.size() < o.on.size(); }
};

// The cube of a point.
std::array<int, 3> cube_of(const Vec3& p, double edge) {
  const Vec3 c = (p / edge).array().floor();
  return {static_cast<int>(c.x()), static_cast<int>(c.y()), static_cast<int>(c.z())};
}

// Points cube by cube, to pass over those that are far from what is looked for.
struct Blocks {
  struct Block {
    Box3 box;
    std::uint32_t begin, end;
  };
  std::vector<Vec3> points;
  std::vector<Block> blocks;

  Blocks(std::span<const Vec3> some, double edge) : points(some.begin(), some.end()) {
    std::stable_sort(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
      return cube_of(a, edge) < cube_of(b, edge);
    });
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      if (i == 0 || cube_of(points[i - 1], edge) != cube_of(points[i], edge))
        blocks.push_back({{}, i, i});
      blocks.back().box.extend(points[i]), blocks.back().end = i + 1;
    }
  }

  template <typename Body>
  void for_each_in(const Vec3& center, double radius, Body body) const {
    const double limit = radius * radius;
    for (const Block& block : blocks)
      if (block.box.squaredExteriorDistance(center) < limit)
        for (std::uint32_t i = block.begin; i < block.end; ++i)
          if ((points[i] - center).squaredNorm() < limit) body(i);
  }
};

class RoundSearch {
 public:
  RoundSearch(std::span<const Vec3> points, double cell, double noise,
              const RoundPartOptions& options)
      : all_(points, 4 * cell), cell_(cell), noise_(noise), options_(options) {}

  std::vector<Ellipsoid> run() {
    std::vector<RoundCandidate> candidates;
    std::vector<char> covered(all_.points.size());
    // Every so many points, in an order that jumps about: the next ones would be neighbours.
    const std::size_t count = all_.points.size();
    const std::size_t seeds = std::min<std::size_t>(count / 16, kSeeds);
    for (std::size_t k = 0; k < seeds; ++k) {
      const double turn = static_cast<double>(k) * 0.6180339887498949;
      const auto seed =
          static_cast<std::size_t>((turn - std::floor(turn)) * static_cast<double>(count));
      if (covered[seed]) continue;
      auto candidate = grow(all_.points[seed], 3 * cell_);
      if (!candidate) candidate = grow(all_.points[seed], 6 * cell_);
      if (!candidate) continue;
      for (std::uint32_t i : candidate->on) covered[i] = 1;
      candidates.push_back(std::move(*candidate));
    }
    return choose(std::move(candidates));
  }

 private:
  double tolerance() const { return options_.tolerance * noise_; }

  // Of no more than so many points, evenly taken.
  std::vector<Vec3> some_of(const Indices& points, std::size_t most) const {
    const std::size_t step = points.size() / most + 1;
    std::vector<Vec3> some;
    for (std::size_t k = 0; k < points.size(); k += step) some.push_back(all_.points[points[k]]);
    return some;
  }

  // From the points around one to all on the ellipsoid that it is on.
  std::optional<RoundCandidate> grow(const Vec3& seed, double reach) const {
    Indices some;
    all_.for_each_in(seed, reach, [&](std::uint32_t i) { some.push_back(i); });
    for (int round = 0; round < 12; ++round) {
      const auto shape = fit_ellipsoid(some_of(some, 150), kStiff * noise_, false);
      if (!shape || shape->radii[2] > 50 * cell_) return std::nullopt;
      const double most = 2 * shape->radii[2] + tolerance();
      reach = std::min(1.4 * reach, most);
      Indices next;
      all_.for_each_in(seed, reach, [&](std::uint32_t i) {
        if (std::abs(shape->signed_distance(all_.points[i])) < tolerance()) next.push_back(i);
      });
      if (next.size() < some.size() / 2) return std::nullopt;
      const bool is_settled = next == some;
      some = std::move(next);
      if (is_settled && reach >= most) break;
    }
    if (some.size() < static_cast<std::size_t>(options_.min_points)) return std::nullopt;
    std::optional<RoundCandidate> best;
    for (int round = 0; round < 2; ++round) {
      const auto shape = fit_ellipsoid(some_of(some, 1000), kSoft * noise_);
      auto candidate = shape ? judged(*shape) : std::nullopt;
      if (!candidate) break;
      some = candidate->on;
      if (!best || best->on.size() < some.size()) best = std::move(candidate);
    }
    return best;
  }

  // With its points, where they prove it.
  std::optional<RoundCandidate> judged(const Ellipsoid& e) const {
    if (e.radii[2] > options_.max_ratio * e.radii[0]) return std::nullopt;
    double inside = 0, beside = 0, square = 0;
    RoundCandidate c{e, {}};
    Indices near;
    all_.for_each_in(e.center, e.radii[2] + 3 * tolerance(), [&](std::uint32_t i) {
      const double off = e.signed_distance(all_.points[i]);
      inside += off < -3 * tolerance();
      if (std::abs(off) >= 3 * tolerance()) return;
      if (std::abs(off) < 2 * tolerance()) near.push_back(i);
      if (std::abs(off) < tolerance())
        c.on.push_back(i), square += off * off;
      else
        ++beside;
    });
    const auto on = static_cast<double>(c.on.size());
    if (on < options_.min_points || square > on * noise_ * noise_ ||
        inside > options_.max_inside * on || beside > options_.max_beside * on ||
        !is_seen_all_over(e, near, on))
      return std::nullopt;
    constexpr double kEnough = 200;  // points
    const double mean_noise = noise_ * std::sqrt(kEnough / std::max(on, kEnough));
    if (uncertainty_of(e, some_of(c.on, static_cast<std::size_t>(kEnough)), mean_noise) >
        options_.max_unknown * noise_)
      return std::nullopt;
    return c;
  }

  // Whether enough sides of an ellipsoid have points, and few are off them on the whole.
  bool is_seen_all_over(const Ellipsoid& e, const Indices& near, double on) const {
    static const std::vector<Vec3> directions = even_directions(kSides);
    struct Count {
      double on = 0, near = 0, off = 0;
    };
    std::array<Count, kSides> sides{};
    for (std::uint32_t i : near) {
      const Vec3& p = all_.points[i];
      const Vec3 q = e.to_ball * (p - e.center);
      std::size_t best = 0;
      double most = -1;
      for (std::size_t k = 0; k < kSides; ++k)
        if (const double h = directions[k].dot(q); h > most) most = h, best = k;
      const double off = e.signed_distance(p);
      sides[best].near += 1, sides[best].off += off;
      sides[best].on += std::abs(off) < tolerance();
    }
    double seen = 0, biased = 0;
    for (const Count& side : sides) {
      seen += side.on > 1;
      if (std::abs(side.off) > noise_ * (kMaxBias * side.near + 3 * std::sqrt(side.near)))
        biased += side.near;
    }
    return seen >= options_.min_seen * kSides && biased <= options_.max_biased * on;
  }

  // The one with most points first, without those that it takes from the others.
  std::vector<Ellipsoid> choose(std::vector<RoundCandidate> candidates) const {
    std::vector<Ellipsoid> chosen;
    std::vector<char> taken(all_.points.size());
    while (!candidates.empty()) {
      const auto best = std::max_element(candidates.begin(), candidates.end());
      if (best->on.size() < static_cast<std::size_t>(options_.min_points)) break;
      const Ellipsoid shape = best->shape;
      chosen.push_back(shape);
      all_.for_each_in(shape.center, shape.radii[2] + tolerance(), [&](std::uint32_t i) {
        taken[i] |= shape.signed_distance(all_.points[i]) < tolerance();
      });
      std::vector<RoundCandidate> left;
      for (RoundCandidate& c : candidates) {
        const auto had = c.on.size();
        std::erase_if(c.on, [&](std::uint32_t i) { return taken[i] != 0; });
        if (3 * c.on.size() > had) left.push_back(std::move(c));
      }
      candidates = std::move(left);
    }
    return chosen;
  }

  Blocks all_;
  double cell_, noise_;
  const RoundPartOptions& options_;
};

// Points in touching cubes.
std::vector<std::vector<Vec3>> connected(const std::vector<Vec3>& points, double cell) {
  struct CubedPoint {
    std::array<int, 3> at;
    std::uint32_t point;
    bool operator<(const CubedPoint& o) const {
      return std::tie(at, point) < std::tie(o.at, o.point);
    }
  };
  std::vector<CubedPoint> sorted;
  for (std::uint32_t i = 0; i < points.size(); ++i) sorted.push_back({cube_of(points[i], cell), i});
  std::sort(sorted.begin(), sorted.end());
  DisjointSets sets(points.size());
  for (const CubedPoint& p : sorted)
    for (const auto& [dx, dy] : {std::pair(0, 0), {0, 1}, {1, -1}, {1, 0}, {1, 1}}) {
      const CubedPoint low{{p.at[0] + dx, p.at[1] + dy, p.at[2] - 1}, 0};
      const std::array<int, 3> high{p.at[0] + dx, p.at[1] + dy, p.at[2] + 1};
      for (auto k = std::lower_bound(sorted.begin(), sorted.end(), low);
           k != sorted.end() && k->at <= high; ++k)
        sets.unite(p.point, k->point);
    }
  std::vector<std::vector<Vec3>> parts;
  std::vector<std::size_t> index(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t root = sets.find(i);
    if (root == i) index[i] = parts.size(), parts.emplace_back();
    parts[index[root]].push_back(points[i]);
  }
  return parts;
}

}  // namespace

RoundParts find_round_parts(std::span<const Vec3> thing, double cell, double noise,
                            const RoundPartOptions& options,
                            const std::function<bool(const Ellipsoid&)>& is_possible) {
  RoundParts parts;
  parts.found = RoundSearch(thing, cell, noise, options).run();
  if (is_possible) std::erase_if(parts.found, [&](const Ellipsoid& e) { return !is_possible(e); });
  if (parts.found.empty()) {
    parts.rest.emplace_back(thing.begin(), thing.end());
    return parts;
  }
  std::vector<Vec3> rest;
  for (const Vec3& p : thing)
    if (std::none_of(parts.found.begin(), parts.found.end(), [&](const Ellipsoid& e) {
          return e.signed_distance(p) < 2 * options.tolerance * noise;
        }))
      rest.push_back(p);
  parts.rest = connected(rest, cell);
  return parts;
}

}  // namespace scanworld
