// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "placing.h"

#include <algorithm>

namespace scanworld::thesis {

std::vector<Cluster> place_clusters(const KdTree& tree, double delta,
                                    const PlacingOptions& options) {
  const std::vector<Vec3>& points = tree.points();
  const Vec3 range = Vec3::Constant(options.range * delta);
  const double min_distance = options.min_distance * delta;
  std::vector<char> taken(points.size());
  std::vector<Cluster> clusters;
  for (int seed : tree.breadth_first()) {
    if (options.number_of_clusters > 0 &&
        clusters.size() == static_cast<std::size_t>(options.number_of_clusters))
      break;
    const Vec3& center = points[static_cast<std::size_t>(seed)];
    if (taken[static_cast<std::size_t>(seed)]) continue;
    std::vector<int> members = tree.range_search(center - range, center + range);
    const auto is_taken = [&](int index) { return taken[static_cast<std::size_t>(index)] != 0; };
    std::erase_if(members, is_taken);
    if (members.size() < static_cast<std::size_t>(options.min_points)) continue;
    const auto fit = fit_plane(points, members);
    if (!fit) continue;
    const bool planar = std::all_of(members.begin(), members.end(), [&](int index) {
      return std::abs(fit->plane.signed_distance(points[static_cast<std::size_t>(index)])) <
             min_distance;
    });
    if (!planar) continue;
    for (int index : members) taken[static_cast<std::size_t>(index)] = 1;
    clusters.push_back({std::move(members), *fit});
  }
  return clusters;
}

}  // namespace scanworld::thesis
