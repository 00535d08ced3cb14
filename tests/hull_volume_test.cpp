// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/hull_volume.h"

#include "support/support.h"
#include "world/solids.h"

using namespace scanworld;
using namespace scanworld::test;

TEST_CASE("the volume of a hull is that which Qhull finds") {
  Random random(1);
  for (int round = 0; round < 300; ++round) {
    const int count = random.whole(4, 40);
    const Vec3 stretch(random.uniform(0.01, 3), random.uniform(0.01, 3), random.uniform(0.01, 3)),
        shift = 20 * random.direction();
    ConvexHull hull;
    for (int i = 0; i < count; ++i) {
      const Vec3 p = round % 2 ? random.direction()
                               : Vec3(random.uniform(-1, 1), random.uniform(), random.uniform());
      hull.vertices.push_back(shift + p.cwiseProduct(stretch));
    }
    if (round % 3 == 0) hull.vertices.push_back(hull.vertices.front());  // twice the same
    CAPTURE(round);
    CHECK(hull_volume(hull.vertices) == doctest::Approx(volume_of(mesh_of(hull))).epsilon(1e-6));
  }
}

TEST_CASE("a lattice, whose faces hold many points each, has the volume of its box") {
  std::vector<Vec3> points;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 3; ++z) points.emplace_back(x, 2 * y, 0.5 * z);
  CHECK(hull_volume(points) == doctest::Approx(2 * 6 * 1));
}

TEST_CASE("points in a plane, a line or a place have none") {
  CHECK(hull_volume({}) == 0);
  CHECK(hull_volume(std::vector<Vec3>(9, Vec3(1, 2, 3))) == 0);
  std::vector<Vec3> line, flat;
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    line.push_back(i * Vec3(1, 2, 3));
    flat.push_back(random.uniform() * Vec3(1, 2, 3) + random.uniform() * Vec3(-1, 0, 2));
  }
  CHECK(hull_volume(line) == 0);
  CHECK(hull_volume(flat) == 0);
}
