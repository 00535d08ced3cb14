// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "../parallel.h"
#include "ray_scene.h"
#include "virtual_scan.h"

namespace scanworld {

namespace {

constexpr double kMaxViewpoints = 3000;  // that are tried, about; all pairs of them are looked at

// Points over the floors where a scanner can stand.
std::vector<Vec3> standing_places(const World& world, const RayScene& scene,
                                  const PlaceOptions& options) {
  const Vec3 up = world.frame.up;
  const PlaneFrame ground = frame_of({up, 0});
  double floor_area = 0;
  for (const Surface& s : world.surfaces)
    if (s.kind == Kind::floor) floor_area += area(world, s);
  const double spacing = std::max(options.spacing, std::sqrt(floor_area / kMaxViewpoints));
  std::vector<Vec3> places;
  for (std::size_t s = 0; s < world.surfaces.size(); ++s) {
    const Surface& floor = world.surfaces[s];
    if (floor.kind != Kind::floor) continue;
    Eigen::AlignedBox2d box;
    for (int index : floor.outer)
      box.extend(ground.to_plane(world.vertices[static_cast<std::size_t>(index)]));
    const Vec2 steps = (box.sizes() / spacing).array().floor();
    for (int i = 0; i <= static_cast<int>(steps.x()); ++i)
      for (int k = 0; k <= static_cast<int>(steps.y()); ++k) {
        const Vec2 at = box.center() + (Vec2(i, k) - steps / 2) * spacing;
        // Down onto the floor from where the scanner would be.
        const Vec3 flat = ground.to_space(at);
        const double rise = floor.plane.normal.dot(up);
        const Vec3 place = flat + up * (options.height - floor.plane.signed_distance(flat) / rise);
        const auto below = scene.cast(place, -up);
        if (!below || !below->is_surface || below->index != s) continue;
        // Room for the scanner, and for the legs that it stands on.
        bool clear = true;
        for (int d = 0; d < 16 && clear; ++d) {
          const double angle = 2 * M_PI * d / 16;
          const Vec3 aside =
              options.clearance * (std::cos(angle) * ground.u + std::sin(angle) * ground.v);
          const Vec3 legs = place - 0.8 * options.height * up;
          clear = scene.is_free(place, place + aside) && scene.is_free(legs, legs + aside);
        }
        if (clear) places.push_back(place);
      }
  }
  return places;
}

}  // namespace

std::vector<Vec3> place_scanners(const World& world, const PlaceOptions& options) {
  const RayScene scene(world);
  const std::vector<Vec3> places = standing_places(world, scene, options);
  std::vector<std::vector<char>> sees(places.size());
  std::vector<double> distances(places.size());  // to all that is seen, together
  parallel_for(places.size(), [&](std::size_t i) {
    sees[i].resize(places.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double distance = (places[i] - places[k]).norm();
      sees[i][k] = distance <= options.reach && scene.is_free(places[i], places[k]);
      if (sees[i][k]) distances[i] += distance;
    }
  });
  std::vector<char> seen(places.size());
  std::vector<Vec3> chosen;
  while (true) {
    std::size_t best = 0;
    std::ptrdiff_t most = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::ptrdiff_t gain = 0;
      for (std::size_t k = 0; k < places.size(); ++k) gain += sees[i][k] && !seen[k];
      // Of places that see as much, one in the middle of it.
      if (gain > most || (gain == most && gain > 0 && distances[i] < distances[best]))
        most = gain, best = i;
    }
    if (most == 0) return chosen;
    chosen.push_back(places[best]);
    for (std::size_t k = 0; k < places.size(); ++k)
      seen[k] = static_cast<char>(seen[k] | sees[best][k]);
  }
}

}  // namespace scanworld
