// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>

#include "types.h"

namespace scanworld {

// A triangle mesh, ready for rays and distances (Embree). Both sides of a triangle are met.
// Thread-safe.
class MeshRays {
 public:
  struct Hit {
    double distance;       // [m] from the ray's origin, or from the point
    std::size_t triangle;  // into Mesh::triangles
  };

  explicit MeshRays(Mesh mesh);
  ~MeshRays();
  MeshRays(const MeshRays&) = delete;
  MeshRays& operator=(const MeshRays&) = delete;

  // What a ray meets first. `direction` is a unit vector; what is not between `near` and `far` [m]
  // is not met. Distances are those of single precision.
  std::optional<Hit> cast(const Vec3& from, const Vec3& direction,
                          double far = std::numeric_limits<float>::max(), double near = 0) const;

  // Whether a ray meets nothing up to `far`.
  bool is_free(const Vec3& from, const Vec3& direction, double far) const;

  // The triangle nearest to a point, if it is within `max_distance`; the first of those that are
  // equally near. Distances are in double precision.
  std::optional<Hit> nearest(const Vec3& point, double max_distance) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scanworld
