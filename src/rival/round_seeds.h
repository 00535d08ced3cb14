// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "curves.h"

namespace scanworld::rival {

constexpr double kReliableRatio = 4;  // of a neighbourhood's variances, for its normal to be one
constexpr double kSmallRadius = 1;    // [m] of a column or pipe; domes are larger

// A round surface through the sites around a place.
struct RoundSeed {
  RoundShape shape;
  std::vector<std::uint32_t> sites;
  double rank = 0;  // the less, the better
};

// Whether each cluster is wider and flatter than any strip of a curve.
std::vector<std::uint8_t> find_wide(const Clustering& clusters, const Scale& scale,
                                    const CurveOptions& options);

// Looks around the flattest site of each block of voxels that is in a cluster which may be a strip
// of a curve: one that is narrow and turned a little against its neighbours. The neighbourhood
// grows until a plane no longer explains it. The best come first, cones after all others.
std::vector<RoundSeed> find_round_seeds(const Grid& grid, const Neighbors& neighbors,
                                        const Scale& scale, const std::vector<LocalPlane>& local,
                                        const Clustering& clusters, const CurveOptions& options);

// The variance of points about a built curve [m2].
inline double variance_of(const Site& site, const RoundShape& shape, const Scale& scale,
                          const CurveOptions& options) {
  const double off = options.roundness * shape.radius_at(site.position());
  return scale.variance_at(site.position()) + off * off;
}

// The most that a site's points may be off a curve, squared [m2].
inline double limit_of(const Site& site, const RoundShape& shape, const Scale& scale,
                       const CurveOptions& options) {
  return square_off(options.max_rms, options.max_distance, site.points) *
         variance_of(site, shape, scale, options);
}

bool has_good_radius(const RoundShape& shape, const CurveOptions& options);

// As many sites as are enough, spread evenly over these.
std::vector<std::uint32_t> some_of(const std::vector<std::uint32_t>& sites, std::size_t enough);

}  // namespace scanworld::rival
