// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "polygons.h"

#include "../parallel.h"
#include "hull.h"

namespace scanworld::thesis {

std::vector<std::vector<Vec3>> fit_to_planes(const std::vector<Vec3>& points,
                                             const std::vector<Cluster>& clusters) {
  std::vector<std::vector<Vec3>> fitted(clusters.size());
  for (std::size_t c = 0; c < clusters.size(); ++c)
    for (int p : clusters[c].members)
      fitted[c].push_back(clusters[c].fit.plane.project(points[static_cast<std::size_t>(p)]));
  return fitted;
}

std::vector<Polygon> find_borders(const std::vector<std::vector<Vec3>>& points,
                                  const std::vector<Cluster>& clusters) {
  std::vector<Polygon> borders(clusters.size());
  parallel_for(clusters.size(), [&](std::size_t c) {
    borders[c] = convex_hull(points[c], clusters[c].fit.plane.normal);
  });
  return borders;
}

}  // namespace scanworld::thesis
