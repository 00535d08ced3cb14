// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/shared_edges.h"

#include <set>

#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

namespace {

FreeEdge upright_edge(int patch, double x, double y) {
  return {patch, {x, y, 0.1}, {x, y, 2}, plane_through({x, y, 0.1}, Vec3::UnitX())};
}

}  // namespace

TEST_CASE("a doorway's edges in both faces of a wall are one, those of the next doorway another") {
  const std::vector<FreeEdge> edges = {upright_edge(0, 1, 0), upright_edge(1, 1.012, 0.2),
                                       upright_edge(0, 1.9, 0), upright_edge(1, 1.9, 0.2),
                                       upright_edge(0, 1, 3)};
  const auto shared = share_edges(edges, std::vector<Patch>(2), {});
  REQUIRE(shared.size() == 3);
  CHECK(shared[0].parts.size() == 2);
  CHECK(shared[0].plane.signed_distance({1.006, 0, 0}) == doctest::Approx(0));
  CHECK(shared[1].parts.size() == 2);
  CHECK(shared[2].parts.size() == 1);
}

TEST_CASE("an edge that ends at a seam goes on in the patch on the other side") {
  LabelledScan scan;
  const int floor = scan.add({0, 0, 0}, {4, 0, 0}, {0, 2, 0});
  const int wall = scan.add({0, 0, 0}, {0, 0, 2.5}, {4, 0, 0});
  const std::vector<Patch> patches = scan.patches();
  const std::vector<Seam> seams = find_seams(patches);
  REQUIRE(seams.size() == 1);
  const auto shared = share_edges({upright_edge(wall, 1, 0)}, patches, seams);
  REQUIRE(shared.size() == 1);
  std::set<int> there;
  for (const auto& part : shared[0].parts) {
    there.insert(part.patch);
    for (const Vec3& end : {part.from, part.to})
      CHECK(std::abs(patches[static_cast<std::size_t>(part.patch)].plane.signed_distance(end)) <
            1e-6);
  }
  CHECK(there == std::set<int>{floor, wall});
}

TEST_CASE("an edge moves to what was seen of its reveal, but not to scattered points") {
  for (bool is_scattered : {false, true}) {
    LabelledScan scan;
    const int wall = scan.add({0, 0, 0}, {1, 0, 0}, {0, 0, 2.5});
    scan.cloud.viewpoints = {Vec3(1, -3, 1)};
    const std::vector<Patch> patches = scan.patches();
    REQUIRE(patches[0].plane.normal.y() < -0.99);
    // The wall seems to end at x = 1.05; its reveal is at 1.02.
    SharedEdge edge{plane_through({1.05, 0, 0}, Vec3::UnitX()),
                    {{wall, {1.05, 0, 0.1}, {1.05, 0, 2}}}};
    Random random(5);
    for (int i = 0; i < 60; ++i)
      scan.cloud.points.emplace_back(
          static_cast<float>(is_scattered ? random.uniform(0.97, 1.13)
                                          : random.uniform(1.017, 1.023)),
          static_cast<float>(random.uniform(0.03, 0.2)),
          static_cast<float>(random.uniform(0.2, 1.9)));
    scan.labels.resize(scan.cloud.points.size(), -1);
    const auto moved =
        move_to_reveals({edge}, patches, surroundings_of(scan.cloud.points, scan.labels));
    const double x = -moved[0].plane.offset;
    CHECK(x == doctest::Approx(is_scattered ? 1.05 : 1.02).epsilon(0.002).scale(0));
  }
}
