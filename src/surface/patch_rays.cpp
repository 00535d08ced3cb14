// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "patch_rays.h"

#include <algorithm>
#include <numeric>

namespace scanworld::surface {

PatchRays::PatchRays(const std::vector<Patch>& patches) {
  Mesh mesh;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const Raster& covered = patches[k].covered;
    for (const CellBox& box : rectangles_of(covered)) {
      const int first = static_cast<int>(mesh.vertices.size());
      for (const auto& [x, y] :
           {std::pair{box.x0, box.y0}, {box.x1, box.y0}, {box.x1, box.y1}, {box.x0, box.y1}})
        mesh.vertices.push_back(patches[k].frame.to_space(covered.low + covered.cell * Vec2(x, y)));
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
      patch_of_.insert(patch_of_.end(), 2, k);
    }
  }
  rays_ = std::make_unique<MeshRays>(mesh);
}

std::optional<PatchRays::Hit> PatchRays::cast(const Vec3& from, const Vec3& direction, double far,
                                              double near) const {
  const auto hit = rays_->cast(from, direction, far, near);
  if (!hit) return std::nullopt;
  return Hit{hit->distance, patch_of_[hit->triangle]};
}

bool PatchRays::is_free(const Vec3& from, const Vec3& to, double margin) const {
  const double length = (to - from).norm();
  return length <= margin || !cast(from, (to - from) / length, length - margin);
}

std::vector<std::size_t> free_viewers(const PatchRays& rays, const std::vector<Vec3>& viewpoints,
                                      const Vec3& place, double margin, std::size_t most) {
  constexpr std::size_t kTries = 4;
  std::vector<std::size_t> order(viewpoints.size()), viewers;
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto tried = order.begin() + static_cast<std::ptrdiff_t>(std::min(kTries, order.size()));
  std::partial_sort(order.begin(), tried, order.end(), [&](std::size_t a, std::size_t b) {
    return (viewpoints[a] - place).squaredNorm() < (viewpoints[b] - place).squaredNorm();
  });
  for (auto v = order.begin(); v != tried && viewers.size() < most; ++v)
    if (rays.is_free(viewpoints[*v], place, margin)) viewers.push_back(*v);
  return viewers;
}

std::vector<std::size_t> find_viewers(const PatchRays& rays, const std::vector<Vec3>& viewpoints,
                                      const Vec3& place, double margin, std::size_t most) {
  if (viewpoints.size() == 1) return {0};
  return free_viewers(rays, viewpoints, place, margin, most);
}

}  // namespace scanworld::surface
