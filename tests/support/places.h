// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Places made by hand, to put robots into.
#pragma once

#include "scenes.h"
#include "sim_check/simulation.h"
#include "world/solids.h"
#include "world/world_json.h"

namespace scanworld::test {

inline ExportBody box_body(const Vec3& low, const Vec3& high) {
  return {.name = "box",
          .position = (low + high) / 2,
          .rotation = Eigen::Quaterniond::Identity(),
          .shape = BoxShape{high - low}};
}

// A place of boxes alone, whose sides are what is seen.
inline sim::Place boxes_place(const std::vector<ExportBody>& boxes) {
  sim::Place place{.name = "boxes", .sort = sim::Sort::world, .solids = boxes};
  for (const ExportBody& box : boxes) append(place.seen, mesh_of(box));
  return place;
}

// A level square of (2 n^2) triangles around the origin.
inline Mesh grid_mesh(int n, double size) {
  Mesh mesh;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x)
      mesh.vertices.push_back(size * Vec3(double(x) / n - 0.5, double(y) / n - 0.5, 0));
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

// A slab whose top is at height 0, as a box and as a hull with an origin and axes of its own.
inline ExportBody slab_body() { return box_body({-3, -3, -0.1}, {3, 3, 0}); }
inline ExportBody slab_hull() {
  ExportBody hull = slab_body();
  Mesh mesh = mesh_of(hull);
  hull.position = {1, 2, 0.5};
  hull.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()));
  for (Vec3& v : mesh.vertices) v = hull.rotation.conjugate() * (v - hull.position);
  hull.shape = ConvexShape{mesh};
  return hull;
}

// So many robots in a row along y, which do not touch.
inline std::vector<sim::Pose> row_of(int count) {
  std::vector<sim::Pose> poses;
  for (int i = 0; i < count; ++i) poses.push_back({Vec3(0, 0.25 * i - 1, 0.06)});
  return poses;
}

inline void run_for(sim::Simulation& simulation, double seconds) {
  for (int i = 0; i < 240 * seconds; ++i) simulation.step(1. / 240);
}

inline World world_named(const std::string& name) {
  return read_world(in_project("worlds/" + name + ".json"));
}

}  // namespace scanworld::test
