// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "join.h"

#include <cmath>

namespace scanworld::rival {

double square_limit(const Cluster& a, const Cluster& b, double bend, const Scale& scale,
                    double max_rms) {
  const double noise = std::max(scale.noise_at(a.fit.centroid), scale.noise_at(b.fit.centroid));
  const double off = std::max({bend, a.roughness, b.roughness});
  return max_rms * max_rms * (noise * noise + off * off);
}

double joint_price(const Cluster& a, const Cluster& b, const Scale& scale, double max_rms,
                   Meeting meeting) {
  const MomentFit joint = fit(a.moments + b.moments);
  const double extent = extent_of(joint);
  const double bend =
      meeting == Meeting::smooth ? scale.flatness.limit_at(extent) : scale.flatness.bend_at(extent);
  return std::max(a.moments.mean_square(joint.plane), b.moments.mean_square(joint.plane)) /
         square_limit(a, b, bend, scale, max_rms);
}

void Joiner::join(std::size_t a, std::size_t b, double roughness) {
  const std::uint32_t low = std::min(find(a), find(b)), high = std::max(find(a), find(b));
  Cluster& whole = c_.clusters[low];
  whole.moments += c_.clusters[high].moments;
  whole.fit = fit(whole.moments);
  whole.roughness = std::max({whole.roughness, c_.clusters[high].roughness, roughness});
  sets_.unite(low, high);
}

Clustering Joiner::finish(const Grid& grid) {
  for (std::size_t i = 0; i < c_.label.size(); ++i)
    if (c_.label[i] != kNone)
      c_.relabel(i, static_cast<std::int32_t>(find(static_cast<std::size_t>(c_.label[i]))));
  refit(grid, c_);
  return std::move(c_);
}

}  // namespace scanworld::rival
