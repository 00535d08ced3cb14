// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/geos.h"

#include "polygon.h"
#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

double area_inside(const std::vector<geos::Rings>& polygons) {
  double twice = 0;  // holes are clockwise
  for (const geos::Rings& rings : polygons)
    for (const auto& ring : rings) twice += doubled_area(ring);
  return twice / 2;
}

std::vector<Vec2> block(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

}  // namespace

TEST_CASE("a polygon without flaw has none, and is what it is made into") {
  const geos::Rings rings = {block(0, 0, 4, 3), block(1, 1, 1, 1)};
  CHECK_FALSE(geos::find_flaw(rings));
  const auto parts = geos::make_valid(rings);
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].size() == 2);
  CHECK(area_inside(parts) == doctest::Approx(11));
}

TEST_CASE("a flaw is told with its place") {
  const auto flaw = geos::find_flaw({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}});
  REQUIRE(flaw);
  CHECK(contains(flaw->reason, "Self-intersection"));
  REQUIRE(flaw->at);
  CHECK((*flaw->at - Vec2(1, 1)).norm() < 1e-9);
  CHECK(contains(*geos::why_invalid({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}), "(1.000, 1.000)"));
}

TEST_CASE("holes take from the outer ring alone, wherever they are") {
  const std::vector<Vec2> outer = block(0, 0, 4, 3);
  CHECK(area_inside(geos::make_valid({outer, block(3, 1, 2, 1)})) == doctest::Approx(11));
  CHECK(area_inside(geos::make_valid({outer, block(6, 1, 2, 1)})) == doctest::Approx(12));
  CHECK(area_inside(geos::make_valid({outer, block(1, 1, 1, 1), block(1.5, 1, 1, 1)})) ==
        doctest::Approx(10.5));
  CHECK(geos::make_valid({outer, block(-1, -1, 6, 5)}).empty());
  const auto parted = geos::make_valid({outer, block(1, -1, 1, 5)});
  CHECK(parted.size() == 2);
  CHECK(area_inside(parted) == doctest::Approx(9));
}

TEST_CASE("whatever rings are, valid polygons are made of them, or none") {
  Random random(5);
  for (int run = 0; run < 500; ++run) {
    CAPTURE(run);
    geos::Rings rings;
    for (int r = random.whole(1, 3); r > 0; --r) {
      std::vector<Vec2>& ring = rings.emplace_back();
      // On a coarse grid corners fall together and edges along each other.
      const bool is_coarse = run % 2;
      for (int k = random.whole(3, 9); k > 0; --k)
        ring.emplace_back(is_coarse ? random.whole(0, 4) : random.uniform(0, 4),
                          is_coarse ? random.whole(0, 4) : random.uniform(0, 4));
    }
    for (const geos::Rings& part : geos::make_valid(rings)) {
      CHECK_FALSE(geos::find_flaw(part));
      CHECK(doubled_area(part[0]) > 0);
      for (std::size_t h = 1; h < part.size(); ++h) CHECK(doubled_area(part[h]) < 0);
    }
  }
}

TEST_CASE("corners that are not finite make no polygon") {
  for (const double bad : {double(NAN), double(INFINITY)})
    for (const geos::Rings& part : geos::make_valid({{{0, 0}, {1, 0}, {1, bad}, {0, 1}}}))
      CHECK_FALSE(geos::find_flaw(part));
}

TEST_CASE("triangles of a polygon with many holes cover it, however it is turned") {
  Random random(4);
  for (int turn = 0; turn < 60; ++turn) {
    const Eigen::Rotation2Dd way(random.uniform(0, 6));
    geos::Rings rings = {block(0, 0, 8, 10)};
    for (int x = 0; x < 4; ++x)
      for (int y = 0; y < 5; ++y)
        if (random.uniform() < 0.7) {
          const double low = random.uniform() < 0.5 ? 0.5 : random.uniform(0.3, 0.7);
          rings.push_back(block(2 * x + low, 2 * y + low, 0.8, random.uniform(0.4, 1.2)));
        }
    for (auto& ring : rings)
      for (Vec2& p : ring) p = way * p;
    const auto triangles = geos::triangulate(rings);
    REQUIRE(triangles);
    double twice = 0, expected = std::abs(doubled_area(rings[0]));
    for (std::size_t h = 1; h < rings.size(); ++h) expected -= std::abs(doubled_area(rings[h]));
    for (const auto& t : *triangles) {
      CHECK(doubled_area(std::vector<Vec2>(t.begin(), t.end())) >= 0);
      twice += doubled_area(std::vector<Vec2>(t.begin(), t.end()));
      for (const Vec2& p : t)
        CHECK(std::any_of(rings.begin(), rings.end(), [&](const auto& ring) {
          return std::find(ring.begin(), ring.end(), p) != ring.end();
        }));
    }
    CHECK(twice == doctest::Approx(expected));
  }
}

TEST_CASE("a Delaunay triangulation covers the hull, and no place is in a triangle's circle") {
  Random random(4);
  std::vector<Vec2> places = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 60; ++i) places.emplace_back(random.uniform(), random.uniform());
  double area = 0;
  for (const auto& t : geos::delaunay(places)) {
    area += doubled_area(std::vector<Vec2>(t.begin(), t.end())) / 2;
    for (const Vec2& p : places) {
      Eigen::Matrix3d in_circle;
      for (int k = 0; k < 3; ++k) {
        const Vec2 d = t[static_cast<std::size_t>(k)] - p;
        in_circle.row(k) << d.x(), d.y(), d.squaredNorm();
      }
      CHECK(in_circle.determinant() < 1e-12);
    }
  }
  CHECK(area == doctest::Approx(1));
  CHECK(geos::delaunay({{0, 0}, {1, 1}}).empty());
}

TEST_CASE("what polygons have in common is cut out of each") {
  const auto parts =
      geos::intersect({{block(0, 0, 4, 1)}, {block(20, 0, 1, 1)}},
                      {{block(1, 0, 1, 2)}, {block(3, -1, 5, 5)}, {block(9, 9, 1, 1)}});
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].size() == 2);
  CHECK(area_inside(parts[0]) == doctest::Approx(2));
  CHECK(parts[1].empty());
}
