// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "flatness.h"

#include <algorithm>
#include <cmath>

#include "../parallel.h"
#include "../quantile.h"

namespace scanworld::rival {

Flatness measure_flatness(const Grid& grid, const Clustering& c, const Flatness& limits,
                          const FlatnessOptions& options) {
  const std::vector<std::vector<std::uint32_t>> members = members_of(c);
  Flatness flatness{.max_bend = limits.max_bend, .max_sag = limits.max_sag};
  double noise = 0;  // [m2] with what bends in the smallest squares
  for (double size = std::max(options.smallest, options.min_voxels * grid.voxel);
       size <= options.largest; size *= 2) {
    // The squared deviation and the area of each.
    using Square = std::pair<double, double>;
    std::vector<std::vector<Square>> of_cluster(c.clusters.size());
    parallel_for(c.clusters.size(), [&](std::size_t k) {
      const MomentFit& f = c.clusters[k].fit;
      for (const Window& w : cut_windows(grid, members[k], f, size, options.windows))
        of_cluster[k].emplace_back(w.square, size * size);
    });
    std::vector<Square> windows;
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
