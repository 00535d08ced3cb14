// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "doubled.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "../parallel.h"
#include "../polygon.h"
#include "surface_rings.h"

namespace scanworld {

namespace {

struct OffPoint {
  double off = 0;  // [m] from the plane
  Vec2 at = Vec2::Zero();
  bool operator<(const OffPoint& o) const { return off < o.off; }
};

struct LayerSums {
  double n = 0, off = 0, off_square = 0;
  Vec2 at = Vec2::Zero(), at_square = Vec2::Zero();

  void add(const OffPoint& p, double sign) {
    n += sign, off += sign * p.off, off_square += sign * p.off * p.off;
    at += sign * p.at, at_square += sign * p.at.cwiseAbs2();
  }
  double mean() const { return off / n; }
  double squares() const { return std::max(0.0, off_square - off * off / n); }
  Vec2 middle() const { return at / n; }
  Vec2 spread() const { return (at_square / n - middle().cwiseAbs2()).cwiseMax(0).cwiseSqrt(); }
};

// Whether the points of a square lie in two layers over all of it.
bool is_doubled(std::vector<OffPoint> points, double square, const DoubledOptions& options) {
  std::sort(points.begin(), points.end());
  LayerSums low, high, best_low, best_high;
  for (const OffPoint& p : points) high.add(p, 1);
  double least = INFINITY;
  const double fewest = std::max(2.0, options.min_share * static_cast<double>(points.size()));
  for (const OffPoint& p : points) {
    low.add(p, 1), high.add(p, -1);
    if (low.n < fewest || high.n < fewest) continue;
    if (const double within = low.squares() + high.squares(); within < least)
      least = within, best_low = low, best_high = high;
  }
  if (!std::isfinite(least)) return false;
  const double apart = best_high.mean() - best_low.mean();
  const double rms = std::sqrt(least / static_cast<double>(points.size()));
  if (apart < std::max(options.min_apart, options.min_apart_per_rms * rms)) return false;
  if ((best_low.middle() - best_high.middle()).norm() > options.max_beside * square) return false;
  const Vec2 a = best_low.spread(), b = best_high.spread();
  return (a.cwiseMin(b).array() >= options.min_spread * a.cwiseMax(b).array()).all();
}

using SurfacePoints = std::vector<std::vector<Vec3>>;

// Surfaces that may be another layer of one, or it.
std::vector<std::size_t> layers_of(const World& world, std::size_t s,
                                   const std::vector<Box3>& boxes, const DoubledOptions& options) {
  std::vector<std::size_t> layers;
  const Surface& own = world.surfaces[s];
  const double least = std::cos(options.max_turn);
  for (std::size_t t = 0; t < world.surfaces.size(); ++t) {
    if (boxes[t].isEmpty() || !grown(boxes[s], options.reach).intersects(boxes[t])) continue;
    const Surface& other = world.surfaces[t];
    if (t == s || (other.plane.normal.dot(own.plane.normal) > least &&
                   std::abs(own.plane.signed_distance(boxes[t].center())) < options.reach))
      layers.push_back(t);
  }
  return layers;
}

}  // namespace

std::optional<double> measure_doubled(const World& world, const std::vector<Vec3>& points,
                                      const std::vector<std::optional<Nearest>>& nearest,
                                      const DoubledOptions& options) {
  SurfacePoints of_surface(world.surfaces.size());
  std::vector<Box3> boxes(world.surfaces.size());
  double whole = 0, count = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (nearest[i] && nearest[i]->is_surface && nearest[i]->distance <= options.reach) {
      of_surface[nearest[i]->index].push_back(points[i]);
      boxes[nearest[i]->index].extend(points[i]), count += 1;
    }
  for (const Surface& s : world.surfaces) whole += area(world, s);
  const double square =
      std::max(options.square, std::sqrt(options.square_points * whole / std::max(count, 1.0)));
  struct Squares {
    double tested = 0, doubled = 0;
  };
  std::vector<Squares> found(of_surface.size());
  parallel_for(found.size(), [&](std::size_t s) {
    if (of_surface[s].size() < options.min_points) return;
    const Plane& plane = world.surfaces[s].plane;
    const PlaneFrame frame = rings_frame(world, world.surfaces[s]);
    std::map<std::pair<int, int>, std::vector<OffPoint>> squares;
    for (std::size_t t : layers_of(world, s, boxes, options))
      for (const Vec3& p : of_surface[t])
        if (const double off = plane.signed_distance(p); std::abs(off) <= options.reach)
          squares[square_of(frame.to_plane(p), square)].push_back({off, frame.to_plane(p)});
    for (const auto& [cell, list] : squares) {
      if (list.size() < options.min_points) continue;
      found[s].tested += 1, found[s].doubled += is_doubled(list, square, options);
    }
  });
  Squares all;
  for (const Squares& s : found) all.tested += s.tested, all.doubled += s.doubled;
  if (all.tested == 0) return std::nullopt;
  return all.doubled / all.tested;
}

}  // namespace scanworld
