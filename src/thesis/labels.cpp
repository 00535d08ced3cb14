// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "labels.h"

#include <algorithm>

#include "../parallel.h"
#include "kd_tree.h"

namespace scanworld::thesis {

std::vector<std::int32_t> label_points(const PointCloud& cloud, const FilteredPoints& filtered,
                                       const std::vector<Cluster>& clusters, const KdTree& tree,
                                       double max_distance) {
  std::vector<std::int32_t> owner(filtered.points.size(), -1);
  for (std::size_t c = 0; c < clusters.size(); ++c)
    for (int p : clusters[c].members)
      owner[static_cast<std::size_t>(p)] = static_cast<std::int32_t>(c);

  const auto distance = [&](std::int32_t c, const Vec3& p) {
    return std::abs(clusters[static_cast<std::size_t>(c)].fit.plane.signed_distance(p));
  };
  std::vector<std::int32_t> labels(cloud.points.size(), -1);
  std::vector<char> undecided(
      filtered.points.size());  // medians with points that are not in their plane
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const int median = filtered.from_input[k];
    if (median < 0) continue;
    const std::int32_t own = owner[static_cast<std::size_t>(median)];
    if (own >= 0 && distance(own, cloud.points[k].cast<double>()) < max_distance / 2)
      labels[k] = own;
    else
      undecided[static_cast<std::size_t>(median)] = 1;
  }

  std::vector<std::vector<std::int32_t>> near(filtered.points.size());
  const Vec3 range = Vec3::Constant(1.5 * filtered.delta);
  for (std::size_t k = 0; k < near.size(); ++k) {
    if (!undecided[k]) continue;
    tree.range_search(filtered.points[k] - range, filtered.points[k] + range, [&](int p) {
      const std::int32_t c = owner[static_cast<std::size_t>(p)];
      if (c >= 0 && std::find(near[k].begin(), near[k].end(), c) == near[k].end())
        near[k].push_back(c);
    });
  }
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const int median = filtered.from_input[k];
    if (median < 0 || labels[k] >= 0) continue;
    double nearest = max_distance;
    for (std::int32_t c : near[static_cast<std::size_t>(median)])
      if (const double d = distance(c, cloud.points[k].cast<double>()); d < nearest)
        nearest = d, labels[k] = c;
  }
  return labels;
}

}  // namespace scanworld::thesis
