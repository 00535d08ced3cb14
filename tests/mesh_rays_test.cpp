// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh_rays.h"

#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;

TEST_CASE("rays meet the nearest triangle in their range, from both sides") {
  Mesh mesh;
  for (double z : {0.0, 1.0}) {
    const int first = static_cast<int>(mesh.vertices.size());
    for (const Vec3& v : {Vec3(0, 0, z), Vec3(2, 0, z), Vec3(0, 2, z)}) mesh.vertices.push_back(v);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const MeshRays rays(mesh);
  CHECK(rays.cast({0.5, 0.5, 3}, -Vec3::UnitZ())->triangle == 1);
  CHECK(rays.cast({0.5, 0.5, -3}, Vec3::UnitZ())->triangle == 0);
  CHECK(rays.cast({0.5, 0.5, 3}, -Vec3::UnitZ())->distance == doctest::Approx(2));
  CHECK(rays.cast({0.5, 0.5, 3}, -Vec3::UnitZ(), 10, 2.5)->triangle == 0);
  CHECK_FALSE(rays.cast({0.5, 0.5, 3}, -Vec3::UnitZ(), 1.5).has_value());
  CHECK_FALSE(rays.cast({1.5, 1.5, 3}, -Vec3::UnitZ()).has_value());
  CHECK_FALSE(MeshRays(Mesh{}).cast({0, 0, 0}, Vec3::UnitZ()).has_value());
}
