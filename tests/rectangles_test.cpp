// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/rectangles.h"

#include "polygon.h"
#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

double area_of(const geos::Rings& rings) {
  double sum = 0;
  for (const auto& ring : rings) sum += doubled_area(ring) / 2;
  return sum;
}

double area_of(const std::vector<geos::Rings>& polygons) {
  double sum = 0;
  for (const auto& rings : polygons) sum += area_of(rings);
  return sum;
}

double union_area(const std::vector<Rectangle>& rectangles) {
  std::vector<geos::Rings> polygons;
  for (const Rectangle& r : rectangles) polygons.push_back(rings_of(r));
  return area_of(geos::unite(polygons));
}

Rectangle rectangle(double x0, double y0, double x1, double y1) {
  return {Vec2(x0, y0), Vec2(x1, y1)};
}

// A wall, 5 m by 2.7 m, with things cut out of it.
geos::Rings wall_without(const std::vector<Rectangle>& openings) {
  std::vector<geos::Rings> others;
  for (const Rectangle& r : openings) others.push_back(rings_of(r));
  const geos::Rings wall = rings_of(rectangle(0, 0, 5, 2.7));
  return others.empty() ? wall : geos::subtract(wall, others, 0.001)[0];
}

std::vector<Rectangle> cover(const geos::Rings& rings) {
  return cover_with_rectangles(rings, {rings});
}

}  // namespace

TEST_CASE("walls with openings take the fewest rectangles") {
  const Rectangle door = rectangle(1, -1, 1.9, 2.1), window = rectangle(3, 0.9, 4, 2.1);
  CHECK(cover(wall_without({})).size() == 1);
  CHECK(cover(wall_without({door})).size() == 3);
  CHECK(cover(wall_without({window})).size() == 4);
  CHECK(cover(wall_without({door, window})).size() == 5);
  CHECK(cover(wall_without({rectangle(0.5, 0.9, 1.5, 2.1), rectangle(2, 0.9, 3, 2.1),
                            rectangle(3.5, 0.9, 4.5, 2.1)}))
            .size() == 6);
}

TEST_CASE("any rectilinear polygon is covered, with nothing outside, by fewer than its rows") {
  Random random(3);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> x = {0}, y = {0};
    const int columns = random.whole(2, 8), rows = random.whole(2, 8);
    for (int i = 0; i < columns; ++i) x.push_back(x.back() + random.uniform(0.05, 1));
    for (int i = 0; i < rows; ++i) y.push_back(y.back() + random.uniform(0.05, 1));
    std::vector<geos::Rings> cells;
    std::size_t runs = 0;
    for (std::size_t r = 0; r + 1 < y.size(); ++r) {
      bool before = false;
      for (std::size_t c = 0; c + 1 < x.size(); ++c) {
        const bool here = random.uniform() < 0.7;
        if (here) cells.push_back(rings_of(rectangle(x[c], y[r], x[c + 1], y[r + 1])));
        runs += here && !before;
        before = here;
      }
    }
    if (cells.empty()) continue;
    std::size_t count = 0;
    for (const geos::Rings& polygon : geos::unite(cells)) {
      const auto rectangles = cover(polygon);
      count += rectangles.size();
      CHECK(union_area(rectangles) == doctest::Approx(area_of(polygon)));
      for (const Rectangle& r : rectangles)
        CHECK(geos::overlap_of(polygon, rings_of(r)).area ==
              doctest::Approx(r.sizes().prod()).epsilon(1e-6));
    }
    CHECK(count <= runs);
  }
}

TEST_CASE("edges that are off by a little stick out by no more than a millimetre") {
  Random random(5);
  for (int round = 0; round < 100; ++round) {
    geos::Rings wall = wall_without({rectangle(1, -1, 1.9, 2.1), rectangle(3, 0.9, 4, 2.1)});
    for (auto& ring : wall)
      for (Vec2& p : ring) p += Vec2(random.uniform(-0.004, 0.004), random.uniform(-0.004, 0.004));
    const auto rectangles = cover(wall);
    CHECK(rectangles.size() == 5);
    std::vector<geos::Rings> covered;
    for (const Rectangle& r : rectangles) {
      covered.push_back(rings_of(r));
      const geos::Rings core =
          rings_of(Rectangle(r.min().array() + 0.0011, r.max().array() - 0.0011));
      CHECK(area_of(geos::subtract(core, {wall}, 1e-6)) < 1e-9);
    }
    CHECK(geos::subtract(wall, covered, 0.02).empty());
  }
}

TEST_CASE("what is done needs no cover, and room to grow is used") {
  const geos::Rings wall = rings_of(rectangle(0, 0, 4, 2));
  CHECK(cover_with_rectangles(wall, {wall}, {wall}).empty());
  const auto rest = cover_with_rectangles(wall, {wall}, {rings_of(rectangle(0, 0, 2.5, 2))});
  REQUIRE(rest.size() == 1);
  CHECK(rest[0].sizes().x() == doctest::Approx(4));
  const auto grown = cover_with_rectangles(wall, {rings_of(rectangle(-0.1, -0.2, 4, 2))});
  REQUIRE(grown.size() == 1);
  CHECK(grown[0].min().isApprox(Vec2(-0.1, -0.2)));
}

TEST_CASE("oblique parts are left out") {
  const geos::Rings gable = {{{0, 0}, {4, 0}, {4, 2}, {2, 3}, {0, 2}}};
  const auto rectangles = cover(gable);
  REQUIRE(rectangles.size() == 1);
  CHECK(rectangles[0].sizes().isApprox(Vec2(4, 2)));
}
