// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "bend.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "../parallel.h"
#include "../polygon.h"
#include "../quantile.h"
#include "surface_rings.h"

namespace scanworld {

namespace {

constexpr double kPerMedian = 1.4826;  // standard deviation per median absolute deviation
constexpr int kFits = 4;               // of fitting, each to what is near the last plane
constexpr double kNearFit = 2.5;       // standard deviations

struct Square {
  double n = 0;
  Vec2 at = Vec2::Zero();          // sum, then mean
  double off = 0, off_square = 0;  // sums, then mean and variance of the mean [m2]
};

std::vector<Square> means_of(const PlaneFrame& frame, const Plane& plane,
                             const std::vector<Vec3>& points, const BendOptions& options) {
  std::map<std::pair<int, int>, Square> sums;
  for (const Vec3& p : points) {
    const Vec2 at = frame.to_plane(p);
    const double off = plane.signed_distance(p);
    Square& s = sums[square_of(at, options.square)];
    s.n += 1, s.at += at, s.off += off, s.off_square += off * off;
  }
  std::vector<Square> means;
  for (const auto& [cell, sum] : sums) {
    if (sum.n < options.min_points) continue;
    Square s{sum.n, sum.at / sum.n, sum.off / sum.n};
    s.off_square = std::max(0.0, sum.off_square / sum.n - s.off * s.off) / (sum.n - 1);
    means.push_back(s);
  }
  return means;
}

// How far the means are off a plane through most of them [m2], less what chance makes of it.
double bend_square(const std::vector<Square>& means) {
  std::vector<double> off(means.size()), chance;
  for (const Square& s : means) chance.push_back(s.off_square);
  double deviation = std::numeric_limits<double>::max();
  for (int round = 0; round < kFits; ++round) {
    Mat3 normal = Mat3::Zero();
    Vec3 right = Vec3::Zero();
    for (std::size_t i = 0; i < means.size(); ++i) {
      if (round > 0 && off[i] > kNearFit * deviation) continue;
      const Vec3 row(means[i].at.x(), means[i].at.y(), 1);
      normal += row * row.transpose(), right += row * means[i].off;
    }
    const Vec3 plane = normal.completeOrthogonalDecomposition().solve(right);
    for (std::size_t i = 0; i < means.size(); ++i)
      off[i] = std::abs(means[i].off - plane.dot(Vec3(means[i].at.x(), means[i].at.y(), 1)));
    deviation = kPerMedian * median(off);
  }
  return std::max(0.0, deviation * deviation - median(chance));
}

}  // namespace

double measure_bend(const World& world, const std::vector<Vec3>& points,
                    const std::vector<std::optional<Nearest>>& nearest,
                    const BendOptions& options) {
  std::vector<std::vector<Vec3>> of_surface(world.surfaces.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (nearest[i] && nearest[i]->is_surface && nearest[i]->distance <= options.reach)
      of_surface[nearest[i]->index].push_back(points[i]);
  std::vector<std::pair<double, double>> bends(of_surface.size());  // squared, and area [m2]
  parallel_for(bends.size(), [&](std::size_t s) {
    const Surface& surface = world.surfaces[s];
    const std::vector<Square> means =
        means_of(rings_frame(world, surface), surface.plane, of_surface[s], options);
    if (means.size() >= options.min_squares) bends[s] = {bend_square(means), area(world, surface)};
  });
  return std::sqrt(weighted_median(std::move(bends)));
}

}  // namespace scanworld
