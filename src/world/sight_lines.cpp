// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sight_lines.h"

#include <algorithm>
#include <cmath>

#include "../parallel.h"

namespace scanworld {

namespace {

// The ray to a point, and whether the world lets it through.
struct Sight {
  Vec3 from, direction;  // the latter a unit vector
  double range;          // [m]
  bool is_free;
};

Sight look_from(const Vec3& viewpoint, const Vec3& point, const RayScene& scene,
                const SightOptions& options) {
  const Vec3 way = point - viewpoint;
  const double range = way.norm();
  const Vec3 direction = range > 0 ? Vec3(way / range) : Vec3::UnitZ();
  return {viewpoint, direction, range,
          range <= options.before || scene.is_free(viewpoint, point - options.before * direction)};
}

Sight find_sight(const SeenPoint& seen, const std::vector<Vec3>& viewpoints, const RayScene& scene,
                 const SightOptions& options) {
  const Vec3& point = seen.at;
  if (seen.viewer >= 0)
    return look_from(viewpoints[static_cast<std::size_t>(seen.viewer)], point, scene, options);
  const Vec3& nearest = nearest_of(viewpoints, point);
  const Sight first = look_from(nearest, point, scene, options);
  if (first.is_free || viewpoints.size() == 1) return first;
  std::vector<Vec3> others = viewpoints;
  std::stable_sort(others.begin(), others.end(), [&](const Vec3& a, const Vec3& b) {
    return (a - point).squaredNorm() < (b - point).squaredNorm();
  });
  for (const Vec3& viewpoint : others)
    if (const Sight sight = look_from(viewpoint, point, scene, options); sight.is_free)
      return sight;
  return first;
}

Vec3 first_met(const Sight& sight, const RayScene& scene) {
  const auto hit = scene.cast(sight.from, sight.direction);
  return sight.from + (hit ? hit->distance : sight.range) * sight.direction;
}

}  // namespace

SightLines follow_sight_lines(const std::vector<SeenPoint>& points,
                              const std::vector<Vec3>& viewpoints, const RayScene& scene,
                              const SightOptions& options) {
  constexpr std::size_t kPart = 256;
  std::vector<SightLines> parts(part_count(points.size(), kPart));
  parallel_for(parts.size(), [&](std::size_t i) {
    const auto [begin, end] = part_of(i, points.size(), kPart);
    SightLines& lines = parts[i];
    for (std::size_t k = begin; k < end; ++k) {
      const SeenPoint& p = points[k];
      const Sight sight = find_sight(p, viewpoints, scene, options);
      if (p.normal && std::abs(p.normal->dot(sight.direction)) < std::cos(options.max_incidence))
        continue;
      if (sight.range > options.min_range) {
        ++lines.free_rays;
        if (!sight.is_free) lines.violations.push_back({sight.from, first_met(sight, scene), p.at});
      }
      if (!p.normal) continue;
      ++lines.ending_rays;
      if (scene.is_free(p.at - options.before * sight.direction,
                        p.at + options.behind * sight.direction))
        lines.leaks.push_back({sight.from, p.at});
    }
  });
  SightLines all;
  for (const SightLines& lines : parts) {
    all.free_rays += lines.free_rays, all.ending_rays += lines.ending_rays;
    all.violations.insert(all.violations.end(), lines.violations.begin(), lines.violations.end());
    all.leaks.insert(all.leaks.end(), lines.leaks.begin(), lines.leaks.end());
  }
  return all;
}

}  // namespace scanworld
