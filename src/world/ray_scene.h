// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>

#include "world.h"

namespace scanworld {

// What a ray meets first.
struct Hit {
  double distance;    // [m] from the ray's origin
  bool is_surface;    // or an obstacle
  std::size_t index;  // into World::surfaces or World::obstacles
};

// What is nearest to a point.
struct Nearest {
  double distance;    // [m]
  bool is_surface;    // or the skin of an obstacle
  std::size_t index;  // into World::surfaces or World::obstacles
};

// The surfaces and obstacles of a world, ready for rays and distances (Embree). Both sides of a
// surface are met. Thread-safe.
class RayScene {
 public:
  explicit RayScene(const World& world);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // `direction` is a unit vector. Distances are those of single precision.
  std::optional<Hit> cast(const Vec3& from, const Vec3& direction,
                          double far = std::numeric_limits<float>::max()) const;
  bool is_free(const Vec3& from, const Vec3& to) const;

  // The surface or obstacle nearest to a point, if it is within `max_distance`; the first of those
  // that are equally near, surfaces before obstacles. Distances are in double precision.
  std::optional<Nearest> nearest(const Vec3& point, double max_distance) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scanworld
