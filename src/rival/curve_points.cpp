// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "curve_points.h"

#include <cmath>

#include "../parallel.h"

namespace scanworld::rival {

std::vector<std::int32_t> label_curve_points(const PointCloud& cloud, const Grid& grid,
                                             const Scale& scale, const Curves& curves,
                                             const CurveOptions& options) {
  std::vector<std::int32_t> labels(cloud.points.size(), kNone);
  parallel_for(part_count(grid.sites.size(), kSitesPerPart), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, grid.sites.size(), kSitesPerPart);
    for (std::size_t i = begin; i < end; ++i) {
      const std::int32_t l = curves.of_site[i];
      if (l == kNone) continue;
      const RoundShape& shape = curves.curves[static_cast<std::size_t>(l)].shape;
      const Vec3 place = grid.sites[i].position();
      const double most =
          options.max_point_distance *
          std::hypot(scale.noise_at(place), options.roundness * shape.radius_at(place));
      for (std::uint32_t point : grid.points_of(i))
        if (std::abs(shape.signed_distance(cloud.points[point].cast<double>())) <= most)
          labels[point] = l;
    }
  });
  return labels;
}

}  // namespace scanworld::rival
