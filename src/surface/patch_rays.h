// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "../mesh_rays.h"
#include "patch.h"

namespace scanworld::surface {

// What patches cover, ready for rays.
class PatchRays {
 public:
  explicit PatchRays(const std::vector<Patch>& patches);

  struct Hit {
    double distance;    // [m] from the ray's origin
    std::size_t patch;  // index
  };

  // What a ray meets first; see MeshRays.
  std::optional<Hit> cast(const Vec3& from, const Vec3& direction, double far,
                          double near = 0) const;

  // Whether nothing is between two points, but for `margin` [m] before the second one.
  bool is_free(const Vec3& from, const Vec3& to, double margin) const;

 private:
  std::vector<std::size_t> patch_of_;  // of each triangle
  std::unique_ptr<MeshRays> rays_;
};

// The viewpoints with a free line to a place, the nearest first and no more than `most` (indices),
// of the four nearest: those that are farther hardly saw it.
std::vector<std::size_t> free_viewers(const PatchRays& rays, const std::vector<Vec3>& viewpoints,
                                      const Vec3& place, double margin, std::size_t most);

// The viewpoints that may have seen a place, as free_viewers(). A single one is taken to have seen
// all.
std::vector<std::size_t> find_viewers(const PatchRays& rays, const std::vector<Vec3>& viewpoints,
                                      const Vec3& place, double margin, std::size_t most);

}  // namespace scanworld::surface
