// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh_rays.h"

#include <embree3/rtcore.h>

#include <algorithm>

namespace scanworld {

namespace {

// The point of a triangle nearest to p, by the region of its plane that p is over (Ericson,
// Real-Time Collision Detection, 2005, 5.1.5).
Vec3 nearest_in_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double over_c = d1 * d4 - d3 * d2;
  if (over_c <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double over_b = d5 * d2 - d1 * d6;
  if (over_b <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const double over_a = d3 * d6 - d5 * d4;
  if (over_a <= 0 && d4 >= d3 && d5 >= d6)
    return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  return a + (ab * over_b + ac * over_c) / (over_a + over_b + over_c);
}

RTCRay ray_of(const Vec3& from, const Vec3& direction, double near, double far) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(from.x());
  ray.org_y = static_cast<float>(from.y());
  ray.org_z = static_cast<float>(from.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tnear = static_cast<float>(near);
  ray.tfar = static_cast<float>(far);
  ray.mask = static_cast<unsigned>(-1);
  return ray;
}

// The nearest triangle so far.
struct Search {
  const Mesh& mesh;
  Vec3 point;
  double slack;  // [m] by which boxes of single precision may be off
  double distance;
  std::optional<unsigned> triangle;
};

// Embree calls this for each triangle whose box is within the query's radius.
bool visit(RTCPointQueryFunctionArguments* args) {
  auto& search = *static_cast<Search*>(args->userPtr);
  const auto& t = search.mesh.triangles[args->primID];
  const auto at = [&](std::size_t k) -> const Vec3& {
    return search.mesh.vertices[static_cast<std::size_t>(t[k])];
  };
  const double distance =
      (nearest_in_triangle(search.point, at(0), at(1), at(2)) - search.point).norm();
  const bool is_nearer = search.triangle ? std::pair(distance, args->primID) <
                                               std::pair(search.distance, *search.triangle)
                                         : distance <= search.distance;
  if (!is_nearer) return false;
  search.distance = distance, search.triangle = args->primID;
  // A little more, so that the order of visits decides nothing.
  args->query->radius = static_cast<float>(distance + search.slack);
  return true;
}

}  // namespace

struct MeshRays::Impl {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
  Mesh mesh;
  double largest = 0;  // [m] coordinate

  explicit Impl(Mesh all) : mesh(std::move(all)) {
    // No ray slips through an edge that two triangles share.
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    if (!mesh.triangles.empty()) add_mesh();
    rtcCommitScene(scene);
  }
  ~Impl() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  void add_mesh() {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* xyz = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                            RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                            mesh.vertices.size()));
    for (const Vec3& v : mesh.vertices) {
      largest = std::max(largest, v.cwiseAbs().maxCoeff());
      for (int k = 0; k < 3; ++k) *xyz++ = static_cast<float>(v[k]);
    }
    auto* corners = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), mesh.triangles.size()));
    for (const auto& t : mesh.triangles)
      for (int index : t) *corners++ = static_cast<unsigned>(index);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }
};

MeshRays::MeshRays(Mesh mesh) : impl_(std::make_unique<Impl>(std::move(mesh))) {}

MeshRays::~MeshRays() = default;

std::optional<MeshRays::Hit> MeshRays::cast(const Vec3& from, const Vec3& direction, double far,
                                            double near) const {
  RTCRayHit ray{};
  ray.ray = ray_of(from, direction, near, far);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{ray.ray.tfar, ray.hit.primID};
}

bool MeshRays::is_free(const Vec3& from, const Vec3& direction, double far) const {
  RTCRay ray = ray_of(from, direction, 0, far);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(impl_->scene, &context, &ray);
  return ray.tfar >= 0;  // minus infinity where it met something
}

std::optional<MeshRays::Hit> MeshRays::nearest(const Vec3& point, double max_distance) const {
  const double slack =
      1e-6 * (1 + std::max(impl_->largest, point.cwiseAbs().maxCoeff()) + max_distance);
  Search search{impl_->mesh, point, slack, max_distance, {}};
  RTCPointQuery query{};
  query.x = static_cast<float>(point.x());
  query.y = static_cast<float>(point.y());
  query.z = static_cast<float>(point.z());
  query.radius = static_cast<float>(max_distance + slack);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(impl_->scene, &query, &context, visit, &search);
  if (!search.triangle) return std::nullopt;
  return Hit{search.distance, *search.triangle};
}

}  // namespace scanworld
