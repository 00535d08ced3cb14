// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "ray_scene.h"

#include "../mesh_rays.h"
#include "solids.h"
#include "triangulate.h"

namespace scanworld {

struct RayScene::Impl {
  std::vector<std::pair<bool, std::size_t>>
      owner;  // of each triangle: surface or not, and its index
  std::optional<MeshRays> rays;
};

RayScene::RayScene(const World& world) : impl_(std::make_unique<Impl>()) {
  WorldMesh surfaces = triangulate(world);
  for (int s : surfaces.surface) impl_->owner.emplace_back(true, static_cast<std::size_t>(s));
  Mesh& all = surfaces.mesh;
  for (std::size_t o = 0; o < world.obstacles.size(); ++o) {
    const Mesh solid = mesh_of(world.obstacles[o], world.frame);
    append(all, solid);
    impl_->owner.insert(impl_->owner.end(), solid.triangles.size(), {false, o});
  }
  impl_->rays.emplace(std::move(all));
}

RayScene::~RayScene() = default;

std::optional<Hit> RayScene::cast(const Vec3& from, const Vec3& direction, double far) const {
  const auto hit = impl_->rays->cast(from, direction, far);
  if (!hit) return std::nullopt;
  const auto& [is_surface, index] = impl_->owner[hit->triangle];
  return Hit{hit->distance, is_surface, index};
}

bool RayScene::is_free(const Vec3& from, const Vec3& to) const {
  const Vec3 way = to - from;
  const double length = way.norm();
  return length == 0 || impl_->rays->is_free(from, way / length, length);
}

std::optional<Nearest> RayScene::nearest(const Vec3& point, double max_distance) const {
  const auto hit = impl_->rays->nearest(point, max_distance);
  if (!hit) return std::nullopt;
  const auto& [is_surface, index] = impl_->owner[hit->triangle];
  return Nearest{hit->distance, is_surface, index};
}

}  // namespace scanworld
