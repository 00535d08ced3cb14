// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "ray_scene.h"

namespace scanworld {

// A point that a scanner saw.
struct SeenPoint {
  Vec3 at;
  std::optional<Vec3> normal;  // of the surface that it lies on, of either sign
  std::int32_t viewer = -1;    // the viewpoint that it is known to have been seen from
};

struct SightOptions {
  double before = 0.1;           // [m] free space ends so far before a point
  double behind = 0.2;           // [m] a surface is met at the latest so far behind its point
  double min_range = 0.3;        // [m] of points whose rays tell of free space
  double max_incidence = 1.309;  // [rad] off the normal (75 degrees); other rays are left out
};

// A ray to a point that met the world before it.
struct Violation {
  Vec3 from, met, point;
};

// A ray to a point of a surface that met nothing there.
struct Leak {
  Vec3 from, point;
};

// How many rays there were, and those of them that a world contradicts, in the order of the points.
struct SightLines {
  std::size_t free_rays = 0;          // from the scanner to before the point
  std::vector<Violation> violations;  // those that met something
  std::size_t ending_rays = 0;        // from before to behind a surface's point
  std::vector<Leak> leaks;            // those that met nothing
};

// Follows the ray to each point from the viewpoint that it was seen from: where that is not known
// the nearest one from where it can be seen, or where there is none the nearest one. At least one
// viewpoint.
SightLines follow_sight_lines(const std::vector<SeenPoint>& points,
                              const std::vector<Vec3>& viewpoints, const RayScene& scene,
                              const SightOptions& options = {});

}  // namespace scanworld
