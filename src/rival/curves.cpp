// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Based on: R. Schnabel, R. Wahl, R. Klein, Efficient RANSAC for Point-Cloud Shape Detection, 2007.
// Its shapes from few points and normals are here those of neighbourhoods of sites, that grow until
// a plane no longer explains them; no random numbers are drawn.
#include "curves.h"

#include <algorithm>
#include <cmath>

#include "../parallel.h"
#include "round_extent.h"
#include "round_fit.h"
#include "round_seeds.h"

namespace scanworld::rival {

namespace {

constexpr int kPasses = 3;             // of growth, each from what the one before found
constexpr double kOtherPlane = 7;      // [noise2] price per point that no plane explains
constexpr double kOffCurve = 16;       // [noise2] and at most of one that the curve does not
constexpr std::size_t kFewSites = 20;  // of a cylinder that is tried as a cone, which must ...
constexpr double kMoreSites = 1.1;     // ... have so many times as many of them
constexpr double kLessSquare = 0.7;    // ... or be off by so much less, in squares

// The sites that a round surface takes.
struct GrownCurve {
  RoundShape shape;
  std::vector<std::uint32_t> sites;
};

class CurveFinder {
 public:
  CurveFinder(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
              const std::vector<LocalPlane>& local, const Clustering& clusters,
              const CurveOptions& options)
      : grid_(grid),
        neighbors_(neighbors),
        scale_(scale),
        local_(local),
        clusters_(clusters),
        options_(options),
        cos_angle_(std::cos(options.max_angle)),
        is_wide_(find_wide(clusters, scale, options)) {
    result_.of_site.assign(grid.sites.size(), kNone);
    tried_.assign(grid.sites.size(), 0), tried_cones_ = tried_;
    stamp_.assign(grid.sites.size(), 0);
  }

  Curves run() {
    for (const RoundSeed& seed :
         find_round_seeds(grid_, neighbors_, scale_, local_, clusters_, options_)) {
      auto& tried = seed.shape.type == CurveType::cone ? tried_cones_ : tried_;
      if (result_.of_site[seed.sites[0]] != kNone || tried[seed.sites[0]]) continue;
      GrownCurve candidate = grow(seed);
      tried[seed.sites[0]] = 1;
      for (std::uint32_t i : candidate.sites) tried[i] = 1;
      if (candidate.shape.type == CurveType::cylinder)
        if (std::optional<GrownCurve> cone = tapered(candidate); cone && judge(*cone)) continue;
      judge(candidate);
    }
    return std::move(result_);
  }

 private:
  double least_height(double radius) const {
    return std::max(options_.min_height, options_.min_slimness * radius);
  }
  // Whether a candidate's sites cannot cover what a curve must.
  bool is_few(const GrownCurve& c) const {
    const double count = static_cast<double>(c.sites.size()), cell = grid_.voxel * grid_.voxel;
    if (count < std::max(20.0, 0.4 * options_.min_area / cell)) return true;
    if (c.shape.radius >= kSmallRadius) return false;
    double low = INFINITY, high = -INFINITY;
    for (std::uint32_t i : c.sites) {
      const double h = c.shape.axis.dot(grid_.sites[i].position());
      low = std::min(low, h), high = std::max(high, h);
    }
    return high - low < 0.8 * least_height(c.shape.radius);
  }

  bool fits(std::uint32_t j, const RoundShape& shape) const {
    if (result_.of_site[j] != kNone) return false;
    const std::int32_t l = clusters_.label[j];
    if (l != kNone && is_wide_[static_cast<std::size_t>(l)]) return false;
    const Site& s = grid_.sites[j];
    if (off_surface(s, shape).square > limit_of(s, shape, scale_, options_)) return false;
    return local_[j].ratio < kReliableRatio ||
           std::abs(local_[j].normal.cast<double>().dot(shape.normal_at(s.position()))) >=
               cos_angle_;
  }

  // Takes the neighbours of its sites that fit, and is fitted again as it grows.
  void spread(GrownCurve& c) {
    std::size_t fit_at = std::max<std::size_t>(c.sites.size() * 5 / 4, 50);
    for (std::size_t k = 0; k < c.sites.size(); ++k) {
      for (std::uint32_t j : neighbors_.of(c.sites[k]))
        if (stamp_[j] != time_ && fits(j, c.shape)) stamp_[j] = time_, c.sites.push_back(j);
      if (c.sites.size() < fit_at) continue;
      if (!refit(c, 200, 3)) return;
      fit_at = c.sites.size() * 5 / 4;
    }
  }

  bool refit(GrownCurve& c, std::size_t enough, int rounds) const {
    if (const auto shape =
            refit_round(c.shape, grid_, some_of(c.sites, enough), options_.weight, rounds))
      c.shape = *shape;
    return has_good_radius(c.shape, options_);
  }

  // Nothing where it cannot become a curve.
  GrownCurve grow(const RoundSeed& seed) {
    GrownCurve c{seed.shape, {}};
    std::vector<std::uint32_t> from = seed.sites;
    for (int pass = 0; pass < kPasses; ++pass) {
      c.sites.clear();
      ++time_;
      for (std::uint32_t i : from)
        if (fits(i, c.shape)) stamp_[i] = time_, c.sites.push_back(i);
      spread(c);
      if (is_few(c) || !refit(c, 2000, 6)) break;
      from = c.sites;
    }
    return c;
  }

  // The mean square that a candidate's points are off it [m2].
  double square_of(const GrownCurve& c) const {
    double square = 0, points = 0;
    for (std::uint32_t i : c.sites)
      square += grid_.sites[i].points * off_surface(grid_.sites[i], c.shape).square,
          points += grid_.sites[i].points;
    return square / std::max(points, 1.0);
  }

  // Whether a cone widens over its sites by more than a cylinder may be off round.
  bool widens(const GrownCurve& c) const {
    double low = INFINITY, high = 0;
    for (std::uint32_t i : c.sites) {
      const double r = c.shape.radius_at(grid_.sites[i].position());
      low = std::min(low, r), high = std::max(high, r);
    }
    return high - low >
           std::max({options_.min_taper, 5 * scale_.noise, options_.min_taper_share * high});
  }

  // The cone that explains more than a cylinder, or explains it better; nothing where none does.
  std::optional<GrownCurve> tapered(const GrownCurve& cylinder) {
    if (cylinder.sites.size() < kFewSites) return std::nullopt;
    RoundShape shape = cylinder.shape;
    shape.type = CurveType::cone;
    const auto cone = refit_round(shape, grid_, some_of(cylinder.sites, 2000), options_.weight, 10);
    if (!cone || !has_good_radius(*cone, options_) || !widens({*cone, cylinder.sites}))
      return std::nullopt;
    GrownCurve grown = grow({*cone, cylinder.sites});
    const bool is_more = static_cast<double>(grown.sites.size()) >
                         kMoreSites * static_cast<double>(cylinder.sites.size());
    if (!widens(grown) || !(is_more || square_of(grown) < kLessSquare * square_of(cylinder)))
      return std::nullopt;
    return grown;
  }

  // Sites that a plane explains as well which has most of its own elsewhere stay with it.
  void leave_to_planes(GrownCurve& c) const {
    std::vector<double> inside(clusters_.clusters.size());
    for (std::uint32_t i : c.sites)
      if (const std::int32_t l = clusters_.label[i]; l != kNone)
        inside[static_cast<std::size_t>(l)] += grid_.sites[i].points;
    std::erase_if(c.sites, [&](std::uint32_t i) {
      const std::int32_t l = clusters_.label[i];
      if (l == kNone) return false;
      const Cluster& plane = clusters_.clusters[static_cast<std::size_t>(l)];
      if (2 * inside[static_cast<std::size_t>(l)] > plane.moments.n) return false;
      const Site& s = grid_.sites[i];
      const double d = plane.fit.plane.signed_distance(s.position());
      return d * d + s.variance(plane.fit.plane.normal) <= off_surface(s, c.shape).square;
    });
  }

  // How much worse planes explain a candidate's points than it does, in squared noise per point.
  double gain_of(const GrownCurve& c) const {
    double gain = 0, points = 0;
    std::vector<double> inside(clusters_.clusters.size());
    std::vector<std::int32_t> around;
    for (std::uint32_t i : c.sites) {
      const Site& s = grid_.sites[i];
      const double n = std::min<double>(s.points, options_.weight);
      const double variance = scale_.variance_at(s.position());
      // What built things are off round anyway is not held against either.
      const double least =
          std::pow(options_.roundness * c.shape.radius_at(s.position()), 2) / variance;
      double by_plane = kOtherPlane;
      if (const std::int32_t l = clusters_.label[i]; l != kNone)
        inside[static_cast<std::size_t>(l)] += s.points;
      around.clear();
      for (std::uint32_t j : neighbors_.of(i))
        if (const std::int32_t l = clusters_.label[j]; l != kNone && add_new(around, l)) {
          const Plane& plane = clusters_.plane(l);
          const double d = plane.signed_distance(s.position());
          by_plane = std::min(by_plane, (d * d + s.variance(plane.normal)) / variance);
        }
      const double by_curve = std::min(off_surface(s, c.shape).square / variance, kOffCurve);
      gain += n * (std::max(by_plane, least) - std::max(by_curve, least));
      points += n;
    }
    for (std::size_t k = 0; k < inside.size(); ++k)
      if (inside[k] > 0 && 2 * inside[k] > clusters_.clusters[k].moments.n) gain += 40;
    return gain / std::max(points, 1.0);
  }

  // How far the planes of the neighbourhoods are turned from the curve (rms) [rad]. Those along the
  // edge of two walls lie on either.
  double turn_of(const GrownCurve& c) const {
    double square = 0, count = 0, all = 0;
    for (std::uint32_t i : c.sites) {
      all += 1;
      if (local_[i].ratio < kReliableRatio) continue;
      const Vec3 normal = c.shape.normal_at(grid_.sites[i].position());
      const double cosine = std::abs(local_[i].normal.cast<double>().dot(normal));
      square += std::pow(std::acos(std::min(cosine, 1.0)), 2), count += 1;
    }
    return count < 0.6 * all ? M_PI : std::sqrt(square / count);
  }

  // Whether something is seen inside: a column is empty, the room that a curved wall bounds has a
  // floor.
  bool is_hollow(const GrownCurve& c, const RoundExtent& e) const {
    const double skin = std::max(0.02, 5 * scale_.noise);
    std::size_t inside = 0;
    for (const Site& s : grid_.sites) {
      const Vec3 p = s.position();
      const double h = c.shape.axis.dot(p - c.shape.point);
      inside += h > e.low && h < e.high && c.shape.way_to(p).norm() < c.shape.radius_at(h) - skin;
    }
    return 4 * inside > c.sites.size();
  }

  // Whether something bends, is covered, and is explained better than by planes. Columns and pipes
  // must show it over a third of their side and be long; what is wider, over its area.
  bool is_round(const GrownCurve& c, const RoundExtent& e) const {
    const double r = c.shape.radius_at((e.low + e.high) / 2), turn = turn_of(c), gain = gain_of(c);
    const double half = half_sweep(c.shape, e, grid_, c.sites);
    if (e.area(c.shape) < options_.min_area) return false;
    if (r * (1 - std::cos(half)) * std::cos(c.shape.half_angle) <
        std::max(options_.min_bend, 5 * scale_.noise))
      return false;
    if (r < kSmallRadius)
      return 2 * half > options_.min_sweep && e.high - e.low > least_height(r) &&
             e.cover > options_.min_cover && gain > options_.min_gain &&
             turn < options_.max_turn + 0.15 * grid_.voxel / r;
    if (c.shape.type == CurveType::sphere && 2 * half < options_.min_dome) return false;
    return 2 * half * 2 * half * e.area(c.shape) > options_.min_wide &&
           e.cover > options_.min_wide_cover && gain > options_.min_wide_gain &&
           turn < options_.max_wide_turn;
  }

  // Keeps a candidate where it is a curve, and tells whether it is.
  bool judge(GrownCurve& c) {
    if (is_few(c) || !has_good_radius(c.shape, options_)) return false;
    if (c.shape.type == CurveType::cone && !widens(c)) return false;
    leave_to_planes(c);
    std::size_t points = 0;
    double square = 0, variance = 0;
    for (std::uint32_t i : c.sites) {
      const Site& s = grid_.sites[i];
      points += s.points;
      square += s.points * off_surface(s, c.shape).square;
      variance += s.points * variance_of(s, c.shape, scale_, options_);
    }
    if (points < static_cast<std::size_t>(options_.min_points)) return false;
    if (square > variance * options_.max_own * options_.max_own) return false;
    // A cone's point is its apex.
    if (c.shape.type == CurveType::cone) {
      c.shape.point -= c.shape.radius / std::tan(c.shape.half_angle) * c.shape.axis;
      c.shape.radius = 0;
    }
    RoundExtent e = extent_of(c.shape, grid_, c.sites);
    if (c.shape.type == CurveType::cone) e.low = std::max(e.low, 0.0);
    if (!is_round(c, e)) return false;
    for (std::uint32_t i : c.sites)
      result_.of_site[i] = static_cast<std::int32_t>(result_.curves.size());
    const double rms = std::sqrt(square / static_cast<double>(points));
    result_.curves.push_back(
        {c.shape, e.low, e.high, e.start, e.sweep, is_hollow(c, e), {points, rms, e.cover}});
    return true;
  }

  const Grid& grid_;
  const Neighbors& neighbors_;
  const Scale& scale_;
  const std::vector<LocalPlane>& local_;
  const Clustering& clusters_;
  const CurveOptions& options_;
  const double cos_angle_;
  const std::vector<std::uint8_t> is_wide_;        // of clusters
  std::vector<std::uint8_t> tried_, tried_cones_;  // of sites
  std::vector<std::uint32_t> stamp_;
  std::uint32_t time_ = 0;
  Curves result_;
};

}  // namespace

Curves find_curves(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                   const std::vector<LocalPlane>& local, const Clustering& clusters,
                   const CurveOptions& options) {
  return CurveFinder(grid, neighbors, scale, local, clusters, options).run();
}

void set_aside(const Curves& curves, const Grid& grid, Neighbors& neighbors,
               std::vector<LocalPlane>& local, Clustering& clusters) {
  if (curves.curves.empty()) return;
  const auto is_round = [&](std::uint32_t i) { return curves.of_site[i] != kNone; };
  parallel_for(neighbors.parts.size(), [&](std::size_t p) {
    Neighbors::Part& part = neighbors.parts[p];
    Neighbors::Part rest;
    for (std::size_t k = 0; k + 1 < part.first.size(); ++k) {
      rest.first.push_back(static_cast<std::uint32_t>(rest.sites.size()));
      if (is_round(static_cast<std::uint32_t>(p * Neighbors::kPart + k))) continue;
      for (std::uint32_t j = part.first[k]; j < part.first[k + 1]; ++j)
        if (!is_round(part.sites[j])) rest.sites.push_back(part.sites[j]);
    }
    rest.first.push_back(static_cast<std::uint32_t>(rest.sites.size()));
    part = std::move(rest);
  });
  for (std::uint32_t i = 0; i < curves.of_site.size(); ++i)
    if (is_round(i)) local[i] = {}, clusters.relabel(i, kNone);
  refit(grid, clusters);
}

}  // namespace scanworld::rival
