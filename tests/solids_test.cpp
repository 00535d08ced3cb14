// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/solids.h"

#include <map>

#include "support/scenes.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// The volume of a closed mesh; each edge must be there once in each direction.
double checked_volume(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> edges;
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    volume += at(0).dot(at(1).cross(at(2))) / 6;
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    CHECK(count == 1);
    CHECK(edges.count({edge.second, edge.first}) == 1);
  }
  return volume;
}

}  // namespace

TEST_CASE("solids are closed, face outwards and have their volume") {
  Random random(1);
  for (int round = 0; round < 50; ++round) {
    const Vec3 size(random.uniform(0.1, 3), random.uniform(0.1, 3), random.uniform(0.1, 3));
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(random.uniform(0, 6), random.direction()));
    CHECK(checked_volume(mesh_of(OrientedBox{10 * random.direction(), size, turn})) ==
          doctest::Approx(size.prod()));
    const ConvexPrism prism{{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},
                            {random.uniform(-1, 1), 0, round % 2 ? 0.5 : -0.5}};
    CHECK(checked_volume(mesh_of(prism)) == doctest::Approx(1));
    ConvexHull corners;
    for (int i = 0; i < 8; ++i)
      corners.vertices.push_back(turn * Vec3(i & 1, i >> 1 & 1, i >> 2 & 1).cwiseProduct(size));
    for (int i = 0; i < 20; ++i)
      corners.vertices.push_back(
          turn * Vec3(random.uniform(), random.uniform(), random.uniform()).cwiseProduct(size));
    CHECK(checked_volume(mesh_of(corners)) == doctest::Approx(size.prod()));
  }
  CHECK(checked_volume(mesh_of(Cylinder{{1, 2, 3}, 0.5, 2}, Vec3::UnitZ(), 256)) ==
        doctest::Approx(M_PI * 0.25 * 2).scale(0).epsilon(1e-3));
  CHECK(checked_volume(mesh_of(Cylinder{{1, 2, 3}, 0.5, 2}, Vec3(0, -0.6, 0.8))) > 1.5);
}

TEST_CASE("points without a volume have no hull") {
  for (const ConvexHull& flat : {ConvexHull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}},
                                 ConvexHull{{{0, 0, 0}, {1, 0, 0}}}, ConvexHull{}})
    error_of(Cause::check_failed, [&] { mesh_of(flat); });
}

TEST_CASE("a convex solid contains the mean of its corners, and nothing beyond a corner") {
  Random random(4);
  for (const Obstacle& obstacle : full_world().obstacles) {
    const Mesh mesh = mesh_of(obstacle, {});
    Vec3 middle = Vec3::Zero();
    for (const Vec3& v : mesh.vertices) middle += v / static_cast<double>(mesh.vertices.size());
    CHECK(contains(mesh, middle));
    for (const Vec3& v : mesh.vertices) {
      CHECK(contains(mesh, middle + 0.999 * (v - middle)));
      CHECK_FALSE(contains(mesh, middle + 1.001 * (v - middle)));
    }
  }
}
