// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "upright.h"

#include "level.h"

namespace scanworld {

Upright::Upright(const World& world) : turn(upright_turn(world.frame)), mesh(triangulate(world)) {
  for (Vec3& v : mesh.mesh.vertices) v = turn * v;
  for (const Surface& s : world.surfaces) normals.push_back(turn * s.plane.normal);
}

std::array<Vec3, 3> Upright::corners(std::size_t triangle) const {
  const auto& t = mesh.mesh.triangles[triangle];
  const auto at = [&](std::size_t k) { return mesh.mesh.vertices[static_cast<std::size_t>(t[k])]; };
  return {at(0), at(1), at(2)};
}

std::vector<Vec3> Upright::ring(const Loop& loop) const {
  std::vector<Vec3> points;
  for (int v : loop) points.push_back(mesh.mesh.vertices[static_cast<std::size_t>(v)]);
  return points;
}

std::optional<Vec2> crossing(const Vec3& p, const Vec3& q, double height) {
  if ((p.z() >= height) == (q.z() >= height)) return std::nullopt;
  const Vec3 at = p + (q - p) * ((height - p.z()) / (q.z() - p.z()));
  return at.head<2>();
}

std::vector<WallCut> cut_at(double height, const Upright& upright) {
  std::vector<WallCut> cuts;
  for (std::size_t t = 0; t < upright.mesh.surface.size(); ++t) {
    const auto corners = upright.corners(t);
    std::vector<Vec2> ends;
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto at = crossing(corners[k], corners[(k + 1) % 3], height)) ends.push_back(*at);
    if (ends.size() != 2) continue;
    const auto s = static_cast<std::size_t>(upright.mesh.surface[t]);
    cuts.push_back({s, ends[0], ends[1], upright.normals[s].head<2>().normalized()});
  }
  return cuts;
}

}  // namespace scanworld
