// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "ray_scene.h"

#include <embree3/rtcore.h>

#include "solids.h"
#include "triangulate.h"

namespace scanworld {

struct RayScene::Impl {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
  std::vector<std::pair<bool, std::size_t>>
      owner;  // of each triangle: surface or not, and its index

  ~Impl() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  void build(const Mesh& mesh) {
    rtcSetSceneFlags(
        scene, RTC_SCENE_FLAG_ROBUST);  // no ray slips through an edge that two triangles share
    if (!mesh.triangles.empty()) {
      RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
      auto* xyz = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                              RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                              mesh.vertices.size()));
      for (const Vec3& v : mesh.vertices)
        for (int k = 0; k < 3; ++k) *xyz++ = static_cast<float>(v[k]);
      auto* corners = static_cast<unsigned*>(
          rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                  3 * sizeof(unsigned), mesh.triangles.size()));
      for (const auto& t : mesh.triangles)
        for (int index : t) *corners++ = static_cast<unsigned>(index);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene, geometry);
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene);
  }
};

RayScene::RayScene(const World& world) : impl_(std::make_unique<Impl>()) {
  WorldMesh surfaces = triangulate(world);
  for (int s : surfaces.surface) impl_->owner.emplace_back(true, static_cast<std::size_t>(s));
  Mesh& all = surfaces.mesh;
  for (std::size_t o = 0; o < world.obstacles.size(); ++o) {
    const Mesh solid = mesh_of(world.obstacles[o], world.frame);
    const int base = static_cast<int>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), solid.vertices.begin(), solid.vertices.end());
    for (const auto& t : solid.triangles) {
      all.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
      impl_->owner.emplace_back(false, o);
    }
  }
  impl_->build(all);
}

RayScene::~RayScene() = default;

std::optional<Hit> RayScene::cast(const Vec3& from, const Vec3& direction, double far) const {
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(from.x());
  ray.ray.org_y = static_cast<float>(from.y());
  ray.ray.org_z = static_cast<float>(from.z());
  ray.ray.dir_x = static_cast<float>(direction.x());
  ray.ray.dir_y = static_cast<float>(direction.y());
  ray.ray.dir_z = static_cast<float>(direction.z());
  ray.ray.tfar = static_cast<float>(far);
  ray.ray.mask = static_cast<unsigned>(-1);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const auto& [is_surface, index] = impl_->owner[ray.hit.primID];
  return Hit{ray.ray.tfar, is_surface, index};
}

bool RayScene::is_free(const Vec3& from, const Vec3& to) const {
  const Vec3 way = to - from;
  const double length = way.norm();
  return length == 0 || !cast(from, way / length, length);
}

}  // namespace scanworld
