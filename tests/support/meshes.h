// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// A scanned room for the dense baselines, and what holds for any mesh they make.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "scenes.h"

namespace scanworld::test {

struct RoomSide {
  Vec3 corner, a, b;

  double distance(const Vec3& p) const {
    const double s = std::clamp((p - corner).dot(a) / a.squaredNorm(), 0.0, 1.0),
                 t = std::clamp((p - corner).dot(b) / b.squaredNorm(), 0.0, 1.0);
    return (p - corner - s * a - t * b).norm();
  }
};

// The sides of a box, with its bottom or without.
inline std::vector<RoomSide> box_sides(const Vec3& corner, const Vec3& size, bool has_bottom) {
  const Vec3 x = Vec3::UnitX() * size.x(), y = Vec3::UnitY() * size.y(),
             z = Vec3::UnitZ() * size.z();
  std::vector<RoomSide> sides = {
      {corner + z, x, y}, {corner, x, z}, {corner + y, x, z}, {corner, y, z}, {corner + x, y, z}};
  if (has_bottom) sides.push_back({corner, x, y});
  return sides;
}

// A room of 6 m by 4 m, 2.5 m high, with a box on the floor.
struct FurnishedRoom {
  std::vector<RoomSide> sides;
  PointCloud cloud;

  explicit FurnishedRoom(double points, double noise = 0.01, std::uint64_t seed = 1)
      : sides(box_sides(Vec3::Zero(), {6, 4, 2.5}, true)) {
    const Vec3 corner(2, 1.5, 0), size(1.2, 0.8, 0.9);
    const std::vector<RoomSide> box = box_sides(corner, size, false);
    sides.insert(sides.end(), box.begin(), box.end());
    double area = 0;
    for (const RoomSide& r : sides) area += r.a.norm() * r.b.norm();
    Random random(seed);
    for (const RoomSide& r : sides)
      add_rectangle(cloud, r.corner, r.a, r.b, std::sqrt(area / points), noise, random);
    const Box3 under(corner - Vec3(0, 0, 0.1), corner + Vec3(size.x(), size.y(), 0.1));
    std::erase_if(cloud.points, [&](const Vec3f& p) {
      const Vec3 at = p.cast<double>(), inside = (at - corner).cwiseMin(corner + size - at);
      return under.contains(at) && inside.head<2>().minCoeff() > 0.05;
    });
  }
};

// How many triangles are at each edge, from its lower to its higher vertex.
inline std::map<std::pair<int, int>, int> faces_at_edges(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> faces;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++faces[std::minmax({t[k], t[(k + 1) % 3]})];
  return faces;
}

inline int border_edges(const Mesh& mesh) {
  int count = 0;
  for (const auto& [edge, faces] : faces_at_edges(mesh)) count += faces == 1;
  return count;
}

// Indices are valid, no triangle is there twice or has a corner twice, every vertex is finite and
// used, and no edge has more triangles than this.
inline void check_dense_mesh(const Mesh& mesh, int max_faces_at_edge = 2) {
  std::set<int> used;
  std::set<std::array<int, 3>> seen;
  bool is_valid = true, is_distinct = true;
  for (auto t : mesh.triangles) {
    std::sort(t.begin(), t.end());
    is_valid = is_valid && t[0] >= 0 && t[2] < static_cast<int>(mesh.vertices.size());
    is_distinct = is_distinct && t[0] < t[1] && t[1] < t[2] && seen.insert(t).second;
    used.insert(t.begin(), t.end());
  }
  CHECK(is_valid);
  CHECK(is_distinct);
  CHECK(used.size() == mesh.vertices.size());
  CHECK(std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                    [](const Vec3& v) { return v.allFinite(); }));
  int most = 0;
  for (const auto& [edge, faces] : faces_at_edges(mesh)) most = std::max(most, faces);
  CHECK(most <= max_faces_at_edge);
}

inline double triangle_area(const Mesh& mesh, const std::array<int, 3>& t) {
  const auto at = [&](int i) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(i)]; };
  return (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).norm() / 2;
}

// [m] Of places all over the mesh, about `density` a square metre, from the nearest side.
inline double mean_error(const Mesh& mesh, const std::vector<RoomSide>& truth,
                         double density = 1000) {
  Random random(1);
  double sum = 0, area = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[static_cast<std::size_t>(t[0])],
               &b = mesh.vertices[static_cast<std::size_t>(t[1])],
               &c = mesh.vertices[static_cast<std::size_t>(t[2])];
    const int places = static_cast<int>(triangle_area(mesh, t) * density) + 1;
    for (int i = 0; i < places; ++i) {
      double u = random.uniform(), v = random.uniform();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 p = a + u * (b - a) + v * (c - a);
      double nearest = truth.front().distance(p);
      for (const RoomSide& r : truth) nearest = std::min(nearest, r.distance(p));
      sum += nearest * triangle_area(mesh, t) / places;
    }
    area += triangle_area(mesh, t);
  }
  return sum / area;
}

inline bool is_same(const Mesh& a, const Mesh& b) {
  return a.vertices == b.vertices && a.triangles == b.triangles;
}

}  // namespace scanworld::test
