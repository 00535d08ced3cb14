// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "flatness.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "../parallel.h"
#include "../polygon.h"
#include "../quantile.h"

namespace scanworld::rival {

namespace {

// How far the points in a square of a cluster's plane are off a plane of their own, squared, and
// the area that they show [m2].
using Window = std::pair<double, double>;

// The squares of this size that a cluster fills well enough.
std::vector<Window> cut_windows(const Grid& grid, const std::vector<std::uint32_t>& sites,
                                const MomentFit& f, double size, const FlatnessOptions& options) {
  const PlaneFrame frame = frame_of(f.plane, f.centroid);
  std::map<std::pair<int, int>, Moments> squares;
  for (std::uint32_t i : sites) {
    const Site& s = grid.sites[i];
    squares[square_of(frame.to_plane(s.position()), size)] += s.moments();
  }
  std::vector<Window> windows;
  for (const auto& [at, moments] : squares) {
    if (moments.n < options.min_points) continue;
    const MomentFit own = fit(moments);
    if (12 * own.variance[1] < std::pow(options.min_filled * size, 2)) continue;
    windows.push_back({own.variance[0] * moments.n / (moments.n - 3), size * size});
  }
  return windows;
}

}  // namespace

Flatness measure_flatness(const Grid& grid, const Clustering& c, const Flatness& limits,
                          const FlatnessOptions& options) {
  const std::vector<std::vector<std::uint32_t>> members = members_of(c);
  Flatness flatness{.max_bend = limits.max_bend, .max_sag = limits.max_sag};
  double noise = 0;  // [m2] with what bends in the smallest squares
  for (double size = std::max(options.smallest, options.min_voxels * grid.voxel);
       size <= options.largest; size *= 2) {
    std::vector<std::vector<Window>> of_cluster(c.clusters.size());
    parallel_for(c.clusters.size(), [&](std::size_t k) {
      const MomentFit& f = c.clusters[k].fit;
      if (12 * f.variance[1] >= std::pow(options.min_filled * size, 2))
        of_cluster[k] = cut_windows(grid, members[k], f, size, options);
    });
    std::vector<Window> windows;
    for (const auto& list : of_cluster) windows.insert(windows.end(), list.begin(), list.end());
    if (windows.size() < options.min_windows) continue;
    const double square = weighted_median(std::move(windows));
    if (noise == 0) noise = square;
    const double bend = square > options.certain * noise ? std::sqrt(square - noise) : 0;
    const double before = flatness.samples.empty() ? 0 : flatness.samples.back().bend;
    flatness.samples.push_back({size, std::min(std::max(bend, before), limits.max_bend)});
  }
  if (!flatness.samples.empty() && flatness.samples.back().bend == 0) flatness.samples.clear();
  return flatness;
}

double Flatness::bend_at(double extent) const {
  if (samples.empty()) return 0;
  const auto next = std::find_if(samples.begin(), samples.end(),
                                 [&](const Sample& s) { return s.extent >= extent; });
  if (next == samples.begin()) return next->bend * extent / next->extent;
  const Sample& last = next[-1];
  if (next == samples.end()) return last.bend * std::min(extent / last.extent, 2.0);
  return std::lerp(last.bend, next->bend, (extent - last.extent) / (next->extent - last.extent));
}

}  // namespace scanworld::rival
