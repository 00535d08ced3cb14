// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "windows.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "../parallel.h"
#include "../polygon.h"
#include "../viewers.h"

namespace scanworld::rival {

namespace {

constexpr double kLeastWindow = 0.3;  // [m] squares that noise is looked at in ...
constexpr double kMinVoxels = 6;      // ... at least so many voxels
constexpr double kMostNoise = 2;      // times that of the scan

}  // namespace

std::vector<Window> cut_windows(const Grid& grid, const std::vector<std::uint32_t>& sites,
                                const MomentFit& f, double size, const WindowOptions& options) {
  if (12 * f.variance[1] < std::pow(options.min_filled * size, 2)) return {};
  const PlaneFrame frame = frame_of(f.plane, f.centroid);
  std::map<std::pair<int, int>, Moments> squares;
  std::map<std::pair<int, int>, std::vector<std::int32_t>> viewers;
  for (std::uint32_t i : sites) {
    const Site& s = grid.sites[i];
    const auto at = square_of(frame.to_plane(s.position()), size);
    squares[at] += s.moments();
    if (!grid.viewers.empty()) viewers[at].push_back(grid.viewers[i]);
  }
  std::vector<Window> windows;
  for (const auto& [at, moments] : squares) {
    if (moments.n < options.min_points) continue;
    const MomentFit own = fit(moments);
    if (12 * own.variance[1] < std::pow(options.min_filled * size, 2)) continue;
    windows.push_back({own, own.variance[0] * moments.n / (moments.n - 3), viewers[at]});
  }
  return windows;
}

double noise_window(const Grid& grid) { return std::max(kLeastWindow, kMinVoxels * grid.voxel); }

std::vector<NoiseSample> sample_noise(const Grid& grid, const Clustering& c,
                                      const std::vector<Vec3>& viewpoints,
                                      const WindowOptions& options) {
  const double size = noise_window(grid);
  const std::vector<std::vector<std::uint32_t>> members = members_of(c);
  std::vector<std::vector<NoiseSample>> of_cluster(c.clusters.size());
  parallel_for(c.clusters.size(), [&](std::size_t k) {
    const Cluster& cluster = c.clusters[k];
    if (cluster.roughness > 0) return;
    for (Window& w : cut_windows(grid, members[k], cluster.fit, size, options))
      of_cluster[k].push_back({w.fit.centroid, w.fit.plane.normal, std::sqrt(w.square), size * size,
                               main_viewer(w.viewers, viewpoints, w.fit.centroid)});
  });
  std::vector<NoiseSample> samples;
  for (const auto& list : of_cluster) samples.insert(samples.end(), list.begin(), list.end());
  return samples;
}

NoiseMap map_noise(const Grid& grid, const Scale& scale, std::span<const NoiseSample> samples) {
  return {samples, noise_window(grid), scale.noise, kMostNoise * scale.noise};
}

}  // namespace scanworld::rival
