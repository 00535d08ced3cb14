// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "bridge.h"

#include <cmath>

#include "join.h"
#include "open_gaps.h"

namespace scanworld::rival {

namespace {

constexpr double kNever = 1e9;      // a price
constexpr double kHidden = 2;       // [voxels] what is hidden is wider
constexpr double kMostNoise = 1.5;  // [max_step] in more a step is not seen

// Joins clusters across gaps as long as the price of what they have become is low enough.
Clustering join_across(const std::vector<Gap>& gaps, const Grid& grid, Clustering c,
                       const GapPrice& price_of) {
  Joiner joiner(std::move(c));
  for (const Gap& gap : gaps)
    if (joiner.find(gap.a) != joiner.find(gap.b) &&
        price_of(joiner.whole(gap.a), joiner.whole(gap.b), gap.middle) < 1)
      joiner.join(gap.a, gap.b);
  return joiner.finish(grid);
}

}  // namespace

GapOptions gaps_of_clusters(const Grid& grid, const BridgeOptions& options) {
  return {.max_gap = options.max_gap * grid.voxel, .open_share = options.open_share};
}

Clustering bridge_clusters(const Grid& grid, const Scale& scale, Clustering c,
                           const BridgeOptions& options) {
  const auto price = [&](const Cluster& a, const Cluster& b, const Vec3&) {
    return joint_price(a, b, scale, options.max_rms, Meeting::apart);
  };
  const std::vector<Gap> gaps = GapFinder(grid, c, gaps_of_clusters(grid, options)).find(price);
  return join_across(gaps, grid, std::move(c), price);
}

Clustering bridge_pieces(const Grid& grid, const Scale& scale, Clustering c,
                         const BridgeOptions& options) {
  const double parallel = std::cos(options.max_angle);
  const auto price = [&](const Cluster& a, const Cluster& b, const Vec3& middle) {
    const Plane &p = a.fit.plane, &q = b.fit.plane;
    const double cosine = p.normal.dot(q.normal), side = cosine < 0 ? -1 : 1;
    if (std::abs(cosine) < parallel || scale.noise_at(middle) > kMostNoise * options.max_step)
      return kNever;
    return std::abs(p.signed_distance(middle) - side * q.signed_distance(middle)) /
           options.max_step;
  };
  const GapOptions widest{options.piece_gap, kHidden * grid.voxel, options.open_share};
  const std::vector<Gap> gaps = GapFinder(grid, c, widest).find(price);
  return join_across(gaps, grid, std::move(c), price);
}

}  // namespace scanworld::rival
