// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sim_check/baselines/tessellate.h"

#include <map>

#include "support/places.h"
#include "world/solids.h"

using namespace scanworld;
using namespace scanworld::sim;
using namespace scanworld::test;

TEST_CASE("a tessellated mesh has the triangles asked for, the same area, and no open seams") {
  const Mesh box = mesh_of(OrientedBox{.size = {4, 3, 2}});
  const Mesh dense = tessellate(box, {.triangles = 5000, .noise = 0});
  CHECK(dense.triangles.size() >= 5000);
  CHECK(dense.triangles.size() < 7000);
  CHECK(area_of(dense) == doctest::Approx(area_of(box)));
  CHECK(volume_of(dense) == doctest::Approx(volume_of(box)));
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : dense.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    CHECK(count == 1);
    CHECK(edges.count({edge.second, edge.first}) == 1);
  }
}

TEST_CASE("its noise is that asked for, along the normals") {
  const Mesh flat = tessellate(grid_mesh(2, 5), {.triangles = 20000, .noise = 0.01});
  double squares = 0;
  for (const Vec3& v : flat.vertices) squares += v.z() * v.z();
  CHECK(std::sqrt(squares / static_cast<double>(flat.vertices.size())) ==
        doctest::Approx(0.01).epsilon(0.05));
  CHECK(contains(error_of(Cause::usage, [&] { tessellate(flat, {.triangles = 0}); }), "triangles"));
}
