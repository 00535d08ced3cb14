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

// The surfaces and obstacles of a world, ready for rays (Embree). Both sides of a surface are met.
// Thread-safe.
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

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scanworld
