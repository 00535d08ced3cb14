// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <set>

#include "space/cells.h"
#include "support/cells.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::space;

TEST_CASE("every cell is found at its own middle") {
  const CellComplex complex = random_complex(10, kCellBox, 80);
  int checked = 0;
  for (std::size_t c = 0; c < complex.cells().size(); ++c) {
    Vec3 sum = Vec3::Zero();
    double count = 0;
    for (const int f : complex.cells()[c].facets)
      for (const int v : complex.facets()[static_cast<std::size_t>(f)].vertices) {
        sum += complex.vertex(v);
        ++count;
      }
    if (complex.volume_of(static_cast<int>(c)) < 1e-9) continue;
    CHECK(complex.cell_at(sum / count) == static_cast<int>(c));
    ++checked;
  }
  CHECK(checked > 200);
}

TEST_CASE("the sides of a facet's middle are its cells") {
  const CellComplex complex = random_complex(11, kCellBox, 80);
  int checked = 0;
  for (const CellFacet& facet : complex.facets()) {
    if (complex.area_of(facet) < 1e-4) continue;
    const Vec3 middle = complex.middle_of(facet);
    double nearest = 1;  // a sliver's middle is on all its edges, as far as doubles know
    for (const int p : facet.edge_planes)
      nearest = std::min(nearest, std::abs(complex.plane(p).signed_distance(middle)));
    if (nearest < 1e-6) continue;
    const auto sides = complex.sides_at(middle, facet.plane);
    REQUIRE(sides);
    CHECK(*sides == facet.cells);
    ++checked;
  }
  CHECK(checked > 500);
  CellComplex two(kCellBox);
  const int plane = two.add_plane(plane_through({1, 0, 0}, Vec3::UnitX())).plane;
  CHECK_FALSE(two.sides_at({1, 0, 0}, plane));
}

TEST_CASE("a walk goes through the cells on the way, each once, through planes they share") {
  const CellComplex complex = random_complex(12, kCellBox, 100);
  Random random(13);
  int steps = 0;
  for (int k = 0; k < 300; ++k) {
    const Vec3 from = random_place(random, kCellBox), to = random_place(random, kCellBox);
    double end = 0;
    int last = -1;
    std::set<int> seen;
    complex.walk(from, to, -1, [&](int cell, double t0, double t1, int plane) {
      CHECK(t0 == end);
      CHECK(t1 > t0);
      CHECK((plane < 0) == (last < 0));
      CHECK(seen.insert(cell).second);
      if (t1 - t0 > 1e-9) CHECK(complex.cell_at(from + (t0 + t1) / 2 * (to - from)) == cell);
      if (plane >= 0) {
        const Vec3 place = from + t0 * (to - from);
        CHECK(std::abs(complex.plane(plane).signed_distance(place)) < 1e-12);
        bool shares = false;
        for (const int f : complex.cells()[static_cast<std::size_t>(cell)].facets) {
          const CellFacet& facet = complex.facets()[static_cast<std::size_t>(f)];
          shares |= facet.plane == plane && (facet.cells[0] == last || facet.cells[1] == last);
        }
        CHECK(shares);
      }
      end = t1;
      last = cell;
      ++steps;
      return true;
    });
    CHECK(end == 1);
  }
  CHECK(steps > 3000);
}

TEST_CASE("a walk ends when told to, and does not cross the plane it is to skip") {
  CellComplex complex(kCellBox);
  const int x = complex.add_plane(plane_through({1, 0, 0}, Vec3::UnitX())).plane;
  const int y = complex.add_plane(plane_through({0, 1, 0}, Vec3::UnitY())).plane;
  for (const int p : {x, y})
    for (int c = static_cast<int>(complex.cells().size()) - 1; c >= 0; --c) complex.split(c, p);
  const Vec3 from(0, 0, 0), to(3, 2, 0);
  std::vector<int> cells;
  const auto note = [&](int cell, double, double, int) {
    cells.push_back(cell);
    return true;
  };
  complex.walk(from, to, -1, note);
  CHECK(cells == std::vector<int>{complex.cell_at({0, 0, 0}), complex.cell_at({1.1, 0, 0}),
                                  complex.cell_at({3, 2, 0})});
  cells.clear();
  complex.walk(from, to, x, note);
  CHECK(cells == std::vector<int>{complex.cell_at({0, 0, 0}), complex.cell_at({0, 2, 0})});
  int visits = 0;
  complex.walk(from, to, -1, [&](int, double, double, int) { return ++visits < 2; });
  CHECK(visits == 2);
  cells.clear();
  complex.walk(from, from, -1, note);
  CHECK(cells == std::vector<int>{complex.cell_at(from)});
}

TEST_CASE("the parts of a polygon cover it, each in its cell") {
  const CellComplex complex = random_complex(14, kCellBox, 100);
  Random random(15);
  int parts = 0;
  for (int k = 0; k < 200; ++k) {
    const auto polygon = random_rectangle(random, random_place(random, kCellBox),
                                          random.direction(), random.uniform(0.01, 3));
    double area = 0;
    complex.clip(polygon, [&](int cell, const std::vector<Vec3>& part) {
      area += area_of(part);
      ++parts;
      if (area_of(part) < 1e-6) return;
      Vec3 middle = Vec3::Zero();
      for (const Vec3& p : part) middle += p / static_cast<double>(part.size());
      CHECK(complex.cell_at(middle) == cell);
    });
    CHECK(area == doctest::Approx(area_of(polygon)).epsilon(1e-6));
  }
  CHECK(parts > 2000);
}

TEST_CASE("what lies in a plane that parts cells there is in none of them") {
  CellComplex complex(kCellBox);
  const int x = complex.add_plane(plane_through({1, 0, 0}, Vec3::UnitX())).plane;
  const int z = complex.add_plane(plane_through({0, 0, 1}, Vec3::UnitZ())).plane;
  complex.split(0, x);
  complex.split(0, z);  // only where x > 1
  double area = 0;
  complex.clip({{-1, 0, 1}, {3, 0, 1}, {3, 2, 1}, {-1, 2, 1}},
               [&](int cell, const std::vector<Vec3>& part) {
                 CHECK(cell == complex.cell_at({-1, 0, 0}));
                 area += area_of(part);
               });
  CHECK(area == doctest::Approx(4));
}
