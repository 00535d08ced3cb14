// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "grid.h"
#include "scale.h"

namespace scanworld::rival {

constexpr std::int32_t kNone = -1;

// Sites that lie in one plane.
struct Cluster {
  Moments moments;
  MomentFit fit;
  double roughness = 0;  // [m] of a surface that is rough beside what noise and bend explain
};

// Which cluster each site is in, or kNone.
struct Clustering {
  std::vector<std::int32_t> label;
  std::vector<Cluster> clusters;
  // Of each site, as of when it last competed: whether a cluster other than its own is among its
  // neighbours; and whether any site that has it among its own neighbours has changed since. Where
  // the density changes, a site may have neighbours of which it is none; their changes it does not
  // see.
  std::vector<std::uint8_t> border, awake;

  bool may_border(std::size_t site) const { return border[site] || awake[site]; }
  const Plane& plane(std::int32_t l) const {
    return clusters[static_cast<std::size_t>(l)].fit.plane;
  }
  // Gives a site another label, and wakes it where it is another.
  void relabel(std::size_t site, std::int32_t l) {
    if (label[site] != l) label[site] = l, awake[site] = 1;
  }
};

// Told of clusters on the way, and in words what just happened to them; it changes nothing.
using Observer = std::function<void(std::string_view what, const Clustering& clusters)>;

inline std::size_t count_of(const Clustering& c) { return c.clusters.size(); }

// The larger extent of a cluster [m].
inline double extent_of(const MomentFit& fit) { return std::sqrt(12 * fit.variance[2]); }

// The area that points spread evenly with these variances cover [m2].
inline double area_of(const MomentFit& fit) {
  return 12 * std::sqrt(fit.variance[1] * fit.variance[2]);
}

// The square of how far the surface of a cluster may be off its plane by itself [m2]: as far as
// those of its extent are in this scan, or as its own points tell, within limits.
double square_bend(const MomentFit& fit, const Scale& scale);

constexpr double kMinPoints = 12;  // that a cluster needs for its plane to mean something

// The standard deviation of a cluster's points off its plane, or `least` [m] where that is more.
inline double noise_of(const Cluster& cluster, double least) {
  return std::max(std::sqrt(cluster.fit.variance[0]), least);
}

// Adds a label to a list that does not have it yet; tells whether it was new.
inline bool add_new(std::vector<std::int32_t>& labels, std::int32_t l) {
  if (std::find(labels.begin(), labels.end(), l) != labels.end()) return false;
  labels.push_back(l);
  return true;
}

// The sites of each cluster, ascending.
std::vector<std::vector<std::uint32_t>> members_of(const Clustering& clustering);

// The square of how far each cluster's surface may be off its plane by itself [m2].
std::vector<double> square_bends(const Clustering& clustering, const Scale& scale);

// Fits all clusters to their sites and drops those with fewer than kMinPoints points.
void refit(const Grid& grid, Clustering& clustering);

}  // namespace scanworld::rival
