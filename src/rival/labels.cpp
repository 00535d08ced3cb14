// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "labels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../parallel.h"
#include "votes.h"

namespace scanworld::rival {

namespace {

// A cluster that the points of a site may belong to.
struct Candidate {
  std::int32_t label;
  double price = 0;  // for being among others, in squared noise
};

// The clusters of the sites around one, its own counting three times.
void find_candidates(std::size_t i, const Neighbors& neighbors, const Clustering& c,
                     double smoothness, Votes& votes, std::vector<Candidate>& near) {
  near.clear();
  const std::int32_t own = c.label[i];
  if (!c.may_border(i)) {
    if (own != kNone) near.push_back({own});
    return;
  }
  const auto around = neighbors.of(i);
  const int total = static_cast<int>(around.size()) + 2;
  for (const auto& [label, count] : votes.count(around, c.label, own)) {
    const int others = total - count - (label == own ? 2 : 0);
    near.push_back({label, smoothness * others / total});
  }
}

}  // namespace

LabelledPoints label_points(const PointCloud& cloud, const Grid& grid, const Neighbors& neighbors,
                            const Scale& scale, const Clustering& c, const LabelOptions& options) {
  std::vector<double> noise;
  for (const Cluster& cluster : c.clusters)
    noise.push_back(noise_of(cluster, options.min_noise * scale.noise));
  const double max_square = options.max_distance * options.max_distance;
  const std::vector<double> bends = square_bends(c, scale);

  LabelledPoints result;
  std::vector<std::int32_t>& labels = result.labels;
  labels.assign(cloud.points.size(), kNone);
  const std::size_t parts = part_count(grid.sites.size(), kSitesPerPart);
  std::vector<std::vector<std::size_t>> counts(parts);
  parallel_for(parts, [&](std::size_t part) {
    const auto [begin, end] = part_of(part, grid.sites.size(), kSitesPerPart);
    counts[part].resize(c.clusters.size());
    Votes votes;
    std::vector<Candidate> near;
    for (std::size_t i = begin; i < end; ++i) {
      find_candidates(i, neighbors, c, options.smoothness, votes, near);
      if (near.empty()) continue;
      const double variance = scale.variance_at(grid.sites[i].position());
      const double local = scale.local.at(grid.sites[i].position());
      for (std::uint32_t point : grid.points_of(i)) {
        const Vec3 p = cloud.points[point].cast<double>();
        double best = std::numeric_limits<double>::max();
        std::int32_t label = kNone;
        for (const Candidate& a : near) {
          const auto k = static_cast<std::size_t>(a.label);
          const double square = std::pow(c.plane(a.label).signed_distance(p), 2);
          const double expected = variance + bends[k];
          const double own = options.max_own * std::max({noise[k], local, c.clusters[k].roughness});
          if (square > std::min(max_square * expected, own * own)) continue;
          double price = square / expected + a.price;
          // A Gaussian that is wider is lower.
          if (c.clusters[k].roughness > 0) price += std::log(expected / variance);
          if (price < best) best = price, label = a.label;
        }
        if (label == kNone) continue;
        labels[point] = label;
        ++counts[part][static_cast<std::size_t>(label)];
      }
    }
  });

  std::vector<std::int32_t> plane_of(c.clusters.size(), kNone);
  for (std::size_t k = 0; k < c.clusters.size(); ++k) {
    std::size_t points = 0;
    for (const auto& count : counts) points += count[k];
    if (points < static_cast<std::size_t>(options.min_points)) continue;
    plane_of[k] = static_cast<std::int32_t>(result.planes.size());
    result.planes.push_back({c.clusters[k].fit, noise[k]});
  }
  parallel_for(part_count(labels.size(), kSitesPerPart), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, labels.size(), kSitesPerPart);
    for (std::size_t i = begin; i < end; ++i)
      if (labels[i] != kNone) labels[i] = plane_of[static_cast<std::size_t>(labels[i])];
  });
  for (const std::int32_t label : c.label)
    result.sites.push_back(label == kNone ? kNone : plane_of[static_cast<std::size_t>(label)]);
  return result;
}

}  // namespace scanworld::rival
