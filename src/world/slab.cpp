// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "slab.h"

#include <algorithm>

#include "../polygon.h"

namespace scanworld {

std::vector<Vec2> Slab::corners() const {
  std::vector<Vec2> ring = rings_of(bounds)[0];
  for (const Side& side : sides) ring = clipped(ring, side.normal, side.offset);
  // Where two sides meet on the outline of `bounds`, the corner is there twice.
  std::vector<Vec2> result;
  for (const Vec2& p : ring)
    if (result.empty() || ((p - result.back()).norm() > 1e-6 && (p - result[0]).norm() > 1e-6))
      result.push_back(p);
  return result.size() < 3 ? std::vector<Vec2>{} : result;
}

Vec3 Slab::to_slab(const Vec3& p) const {
  const Vec2 q = frame.to_plane(p);
  return {q.x(), q.y(), -normal().dot(p - frame.origin)};
}

Vec3 Slab::to_space(const Vec2& p, double at_depth) const {
  return frame.to_space(p) - at_depth * normal();
}

Box3 Slab::box() const {
  Box3 box;
  for (const Vec2& p : corners()) box.extend(to_space(p, 0)).extend(to_space(p, depth));
  return box;
}

std::vector<std::vector<Vec3>> Slab::outline() const {
  const std::vector<Vec2> ring = corners();
  std::vector<std::vector<Vec3>> faces(2);
  for (const Vec2& p : ring)
    faces[0].push_back(to_space(p, 0)), faces[1].push_back(to_space(p, depth));
  std::reverse(faces[1].begin(), faces[1].end());
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    faces.push_back({to_space(a, 0), to_space(a, depth), to_space(b, depth), to_space(b, 0)});
  }
  return faces;
}

Slab slab_of(std::size_t surface, const PlaneFrame& frame, const Rectangle& r, double depth) {
  return {surface,
          frame,
          r,
          {{{0, -1}, -r.min().y(), 0},
           {{1, 0}, r.max().x(), 0},
           {{0, 1}, r.max().y(), 0},
           {{-1, 0}, -r.min().x(), 0}},
          true,
          depth};
}

Collider collider_of(const Slab& slab, int surface_id) {
  const std::vector<Vec2> ring = slab.corners();
  if (!slab.is_box) {
    ConvexPrism prism;
    for (const Vec2& p : ring) prism.base.push_back(slab.to_space(p, 0));
    prism.extrusion = -slab.depth * slab.normal();
    return {surface_id, prism};
  }
  Rectangle r;
  for (const Vec2& p : ring) r.extend(p);
  Mat3 axes;
  axes << slab.frame.u, slab.frame.v, slab.normal();
  return {surface_id, OrientedBox{slab.to_space(r.center(), slab.depth / 2),
                                  {r.sizes().x(), r.sizes().y(), slab.depth},
                                  Eigen::Quaterniond(axes).normalized()}};
}

}  // namespace scanworld
