// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../disjoint_sets.h"
#include "cluster.h"
#include "scale.h"

namespace scanworld::rival {

// How two clusters lie to each other: what goes on into the other without a step may bend more.
enum class Meeting { smooth, apart };

// The square of `max_rms` times what points are off the plane of two clusters: by the noise where
// they are, the larger of the two, and by a bend [m2].
double square_limit(const Cluster& a, const Cluster& b, double bend, const Scale& scale,
                    double max_rms);

// The mean square of two clusters' points about the plane in common, the larger of the two, over
// that limit: under 1 where one plane serves both.
double joint_price(const Cluster& a, const Cluster& b, const Scale& scale, double max_rms,
                   Meeting meeting);

// Joins clusters, each time into that with the lower number, and fits what they make together.
// Sites keep their labels until the end.
class Joiner {
 public:
  explicit Joiner(Clustering c) : c_(std::move(c)), sets_(c_.clusters.size()) {}

  const Clustering& clustering() const { return c_; }
  std::uint32_t find(std::size_t cluster) { return sets_.find(cluster); }
  // What the cluster is part of by now.
  const Cluster& whole(std::size_t cluster) { return c_.clusters[find(cluster)]; }

  // What is joined may be rough beside noise [m].
  void join(std::size_t a, std::size_t b, double roughness = 0);
  // Gives the sites their new labels and wakes those.
  Clustering finish(const Grid& grid);

 private:
  Clustering c_;
  DisjointSets sets_;
};

}  // namespace scanworld::rival
