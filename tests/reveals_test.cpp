// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/reveals.h"

#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

namespace {

// A wall 0.2 m thick between y = 0 and y = 0.2 with an opening from x = 1 to 2 and z = 0 to 2: its
// two faces (planes 0 and 1), the floor (2), and the edges' planes x = 1 (3), x = 2 (4), z = 2 (5).
Pieces wall_with_opening() {
  Pieces pieces;
  pieces.planes = {
      plane_through({0, 0, 0}, -Vec3::UnitY()), plane_through({0, 0.2, 0}, Vec3::UnitY()),
      plane_through({0, 0, 0}, Vec3::UnitZ()),  plane_through({1, 0, 0}, Vec3::UnitX()),
      plane_through({2, 0, 0}, -Vec3::UnitX()), plane_through({0, 0, 2}, -Vec3::UnitZ())};
  pieces.patches = 3, pieces.edges = 3;
  for (int face : {0, 1}) {
    const double y = 0.2 * face;
    std::vector<Corner> notch = {{{face, 2, 3}, 3, {1, y, 0}},
                                 {{face, 3, 5}, 5, {1, y, 2}},
                                 {{face, 4, 5}, 4, {2, y, 2}},
                                 {{face, 2, 4}, 2, {2, y, 0}}};
    if (face == 1) {
      std::reverse(notch.begin(), notch.end());
      const int next[] = {4, 5, 3, 2};
      for (std::size_t k = 0; k < 4; ++k) notch[k].next = next[k];
    }
    pieces.polygons.push_back({face, {notch}});
  }
  return pieces;
}

}  // namespace

TEST_CASE("an opening's sides are closed between the two faces, its bottom is the floor's") {
  const Pieces pieces = add_reveals(wall_with_opening());
  REQUIRE(pieces.polygons.size() == 5);
  double area = 0;
  for (std::size_t k = 2; k < 5; ++k) {
    const CornerPolygon& reveal = pieces.polygons[k];
    CHECK(pieces.is_edge(reveal.patch));
    REQUIRE(reveal.loops.size() == 1);
    const auto& loop = reveal.loops[0];
    REQUIRE(loop.size() == 4);
    const Plane& plane = pieces.planes[static_cast<std::size_t>(reveal.patch)];
    for (std::size_t i = 0; i < 4; ++i) {
      const Corner &corner = loop[i], &next = loop[(i + 1) % 4];
      CHECK(std::abs(plane.signed_distance(corner.at)) < 1e-9);
      // The edge runs along the plane that the corner names.
      const Plane& along = pieces.planes[static_cast<std::size_t>(corner.next)];
      CHECK(std::abs(along.signed_distance(corner.at)) < 1e-9);
      CHECK(std::abs(along.signed_distance(next.at)) < 1e-9);
    }
    const double twice = plane.normal.dot((loop[2].at - loop[0].at).cross(loop[3].at - loop[1].at));
    CHECK(twice > 0);
    area += twice / 2;
  }
  CHECK(area == doctest::Approx(0.2 * (2 + 2 + 1)));
}

TEST_CASE("nothing is closed between faces that are too far apart, or look at each other") {
  RevealOptions narrow;
  narrow.max_thickness = 0.15;
  CHECK(add_reveals(wall_with_opening(), narrow).polygons.size() == 2);
  Pieces facing = wall_with_opening();
  for (std::size_t k : {0u, 1u}) facing.planes[k] = facing.planes[k].flipped();
  CHECK(add_reveals(facing).polygons.size() == 2);
}
