// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "glass.h"

#include <algorithm>
#include <optional>

#include "../parallel.h"

namespace scanworld {

namespace {

// Viewpoints that see little of a window, aslant or from afar, do not count.
constexpr double kMinCosine = 0.3, kMaxRange = 10;  // [m]

// A window, spanned by x and y of `frame`.
struct Pane {
  Plane plane;
  PlaneFrame frame;
  Eigen::AlignedBox2d box, rim;
  Vec3 middle;
};

Pane pane_of(const World& world, const Opening& window, double rim) {
  const Surface* surface = find_surface(world, window.surface);
  const Vec3& corner = world.vertices[static_cast<std::size_t>(window.loop[0])];
  Pane pane{.plane = surface->plane,
            .frame = upright_frame(surface->plane, world.frame.up, corner),
            .middle = {}};
  for (int v : window.loop)
    pane.box.extend(pane.frame.to_plane(world.vertices[static_cast<std::size_t>(v)]));
  pane.rim = {pane.box.min().array() - rim, pane.box.max().array() + rim};
  pane.middle = pane.frame.to_space(pane.box.center());
  return pane;
}

// Where one looks through a window from: the nearest viewpoint that looks at it. Others may be
// beyond further walls.
std::optional<Vec3> eye_of(const Pane& pane, const std::vector<Vec3>& viewpoints, double standoff) {
  if (viewpoints.empty()) return pane.middle + standoff * pane.plane.normal;
  std::optional<Vec3> nearest;
  double best = kMaxRange;
  for (const Vec3& v : viewpoints) {
    const double range = (v - pane.middle).norm();
    if (range < best && std::abs(pane.plane.signed_distance(v)) > kMinCosine * range)
      nearest = v, best = range;
  }
  return nearest;
}

bool is_glass(const Pane& pane, const std::vector<Vec3>& places,
              const std::vector<Vec3>& viewpoints, const std::vector<std::int32_t>& viewers,
              const Vec3& eye, const GlassOptions& options) {
  std::size_t around = 0, through = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3& place = places[i];
    const double distance = pane.plane.signed_distance(place);
    if (std::abs(distance) < options.behind / 3) {
      const Vec2 p = pane.frame.to_plane(place);
      around += pane.rim.contains(p) && !pane.box.contains(p);
    } else if (std::abs(distance) > options.behind && std::abs(distance) < options.depth) {
      const bool knows = !viewers.empty() && viewers[i] >= 0;
      const Vec3& from = knows ? viewpoints[static_cast<std::size_t>(viewers[i])] : eye;
      const double before = pane.plane.signed_distance(from);
      const Vec3 at = from + (place - from) * (before / (before - distance));
      through += (before > 0) != (distance > 0) && pane.box.contains(pane.frame.to_plane(at));
    }
  }
  const double density = static_cast<double>(around) / (pane.rim.volume() - pane.box.volume());
  return static_cast<double>(through) < options.share * density * pane.box.volume();
}

}  // namespace

std::vector<Opening> flag_glass(const World& world, std::vector<Opening> openings,
                                const std::vector<Vec3>& places,
                                const std::vector<Vec3>& viewpoints,
                                const std::vector<std::int32_t>& viewers,
                                const GlassOptions& options) {
  parallel_for(openings.size(), [&](std::size_t i) {
    if (openings[i].kind != OpeningKind::window) return;
    const Pane pane = pane_of(world, openings[i], options.rim);
    const auto eye = eye_of(pane, viewpoints, options.standoff);
    openings[i].glass = eye && is_glass(pane, places, viewpoints, viewers, *eye, options);
  });
  return openings;
}

World with_panes(World world) {
  for (const Opening& o : world.openings) {
    if (!o.glass) continue;
    if (const Surface* s = find_surface(world, o.surface)) {
      Surface pane = *s;
      pane.outer = o.loop, pane.holes.clear();
      world.surfaces.push_back(std::move(pane));
    }
  }
  return world;
}

}  // namespace scanworld
