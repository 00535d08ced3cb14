// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "space/cells.h"
#include "support/cells.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::space;

namespace {

// All numbers that a complex shows.
std::vector<double> numbers_in(const CellComplex& complex) {
  std::vector<double> out;
  for (std::size_t v = 0; v < complex.vertex_count(); ++v)
    for (int k = 0; k < 3; ++k) out.push_back(complex.vertex(static_cast<int>(v))[k]);
  for (const CellFacet& f : complex.facets()) {
    out.insert(out.end(), {double(f.plane), double(f.cells[0]), double(f.cells[1])});
    out.insert(out.end(), f.vertices.begin(), f.vertices.end());
    out.insert(out.end(), f.edge_planes.begin(), f.edge_planes.end());
  }
  for (const Cell& c : complex.cells()) out.insert(out.end(), c.facets.begin(), c.facets.end());
  for (const CellNode& n : complex.nodes())
    out.insert(out.end(), {double(n.plane), double(n.child[0]), double(n.child[1])});
  return out;
}

}  // namespace

TEST_CASE("a complex begins as its box") {
  const CellComplex complex(kCellBox);
  check(complex);
  CHECK(complex.cells().size() == 1);
  CHECK(complex.facets().size() == 6);
  CHECK(complex.vertex_count() == 8);
  CHECK(complex.volume_of(0) == doctest::Approx(kCellBox.volume()));
  double area = 0;
  for (const CellFacet& f : complex.facets()) {
    area += complex.area_of(f);
    CHECK(f.cells[0] == -1);
    for (const int v : f.vertices) {
      CHECK(std::abs(complex.plane(f.plane).signed_distance(complex.vertex(v))) < 1e-12);
      CHECK(kCellBox.contains(complex.vertex(v)));
    }
    CHECK(complex.plane(f.plane).signed_distance(kCellBox.center()) < 0);
  }
  CHECK(area == doctest::Approx(2 * (8 * 6 + 6 * 3 + 3 * 8)));
}

TEST_CASE("a plane parts a cell in two that share a facet, or leaves it whole") {
  CellComplex complex(kCellBox);
  const int wall = complex.add_plane(plane_through({1, 0, 0}, Vec3::UnitX())).plane;
  REQUIRE(complex.split(0, wall));
  check(complex);
  CHECK(complex.volume_of(0) == doctest::Approx(4 * 6 * 3));
  CHECK(complex.volume_of(1) == doctest::Approx(4 * 6 * 3));
  CHECK(complex.facets().back().cells == std::array<int, 2>{0, 1});
  CHECK(complex.area_of(complex.facets().back()) == doctest::Approx(18));
  CHECK(complex.cell_at({2, 0, 0}) == 0);
  CHECK(complex.cell_at({-2, 0, 0}) == 1);
  CHECK(complex.cell_at({-200, 0, 0}) == 1);
  CHECK_FALSE(complex.split(0, wall));
  CHECK_FALSE(complex.split(1, wall));
  const int beyond = complex.add_plane(plane_through({2, 0, 0}, Vec3::UnitX())).plane;
  CHECK_FALSE(complex.split(1, beyond));
  const int along_edge =
      complex.add_plane(plane_through(kCellBox.max(), Vec3(1, 1, 0).normalized())).plane;
  CHECK_FALSE(complex.split(0, along_edge));
  check(complex);
}

TEST_CASE("a plane that is there already is found, seen from either side") {
  CellComplex complex(kCellBox);
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    const Plane plane = plane_through(random_place(random, kCellBox), random.direction());
    const auto first = complex.add_plane(plane), again = complex.add_plane(plane),
               other = complex.add_plane(plane.flipped());
    CHECK(first.plane == CellComplex::kBoxPlanes + k);
    CHECK_FALSE(first.is_flipped);
    CHECK(again.plane == first.plane);
    CHECK_FALSE(again.is_flipped);
    CHECK(other.plane == first.plane);
    CHECK(other.is_flipped);
    CHECK(complex.add_plane(complex.plane(first.plane)).plane == first.plane);
    CHECK((complex.plane(first.plane).normal - plane.normal).norm() < 1e-6);
  }
  const auto floor = complex.add_plane(plane_through(kCellBox.min(), Vec3::UnitZ()));
  CHECK(floor.plane < CellComplex::kBoxPlanes);
  CHECK(floor.is_flipped);
}

TEST_CASE("three planes through one line part a box in six") {
  for (const double turn : {0.0, 0.3}) {
    CellComplex complex(kCellBox);
    const Vec3 axis = Vec3(std::sin(turn), 0, std::cos(turn)), place(1, 1, 0.5);
    for (int k = 0; k < 3; ++k) {
      // In whole numbers they share the line if it is upright; if not, slivers are right.
      const Vec3 side = Eigen::AngleAxisd(k * M_PI / 3, axis) * axis.unitOrthogonal();
      split_all(complex, plane_through(place, side));
    }
    check(complex);
    if (turn == 0) CHECK(complex.cells().size() == 6);
    CHECK(complex.cells().size() >= 6);
  }
}

TEST_CASE("four planes through one point have one vertex there") {
  CellComplex complex(kCellBox);
  const Vec3 place(1, 1, 0.5);  // the middle, so that rounded planes are through it
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 1),
                             Vec3(0.3, -0.5, 0.7), Vec3(-0.2, 0.9, 0.1)}) {
    split_all(complex, plane_through(place, normal.normalized()));
    check(complex);
  }
  int there = 0;
  for (std::size_t v = 0; v < complex.vertex_count(); ++v)
    there += (complex.vertex(static_cast<int>(v)) - place).norm() < 1e-3;
  CHECK(there == 1);
  // n planes through a point, no three of them through a line, part space in n^2 - n + 2 cells.
  CHECK(complex.cells().size() >= 6 * 5 + 2 - 1);
}

TEST_CASE("two ceilings a centimetre apart leave a layer between them") {
  CellComplex complex(kCellBox);
  const Vec3 up = Vec3(0.01, 0.02, 1).normalized();
  split_all(complex, plane_through({1, 1, 1.5}, up));
  split_all(complex, plane_through(Vec3(1, 1, 1.5) + 0.01 * up, up));
  split_all(complex, plane_through({1, 1, 0}, Vec3(1, 0.01, 0).normalized()));
  check(complex);
  CHECK(complex.cells().size() == 6);
  const int left = complex.cell_at(Vec3(0, 1, 1.5 + 0.01) + 0.005 * up);
  const int right = complex.cell_at(Vec3(2, 1, 1.5 - 0.01) + 0.005 * up);
  CHECK(left != right);
  CHECK(complex.volume_of(left) + complex.volume_of(right) ==
        doctest::Approx(0.01 * 8 * 6 / up.z()).epsilon(1e-4));
}

TEST_CASE("a tilted room in a box is one of 27 cells, and all volumes are right") {
  const Mat3 turn = (Eigen::AngleAxisd(0.2, Vec3(1, 2, 3).normalized())).toRotationMatrix();
  const Box3 place(Vec3::Constant(-10), Vec3::Constant(10));
  CellComplex complex(place);
  const Vec3 size(3, 2, 1.5);  // halves
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      split_all(complex, plane_through(turn * (sign * size[axis] * Vec3::Unit(axis)),
                                       sign * turn.col(axis)));
  check(complex);
  CHECK(complex.cells().size() == 27);
  CHECK(complex.volume_of(complex.cell_at(Vec3::Zero())) ==
        doctest::Approx(8 * size.prod()).epsilon(1e-5));
  // Opposite cells are alike, as the room is in the middle.
  for (int k = 0; k < 27; ++k) {
    const Vec3 way(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    const Vec3 at = turn * (way.array() * (size.array() + 0.5)).matrix();
    CHECK(complex.volume_of(complex.cell_at(at)) ==
          doctest::Approx(complex.volume_of(complex.cell_at(-at))).epsilon(1e-5));
  }
}

TEST_CASE("random planes through all cells keep what must hold") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Random random(seed);
    CellComplex complex(kCellBox);
    for (int k = 0; k < 12; ++k)
      split_all(complex, plane_through(random_place(random, kCellBox), random.direction()));
    check(complex);
    CHECK(complex.cells().size() > 60);
  }
}

TEST_CASE("random patches keep what must hold, on a grid and off it") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const CellComplex complex = random_complex(seed, kCellBox, 100);
    check(complex);
    CHECK(complex.cells().size() > 300);
  }
}

TEST_CASE("planes of a coarse lattice, many through each line and point, keep what must hold") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Random random(seed);
    CellComplex complex(Box3(Vec3::Constant(-2), Vec3::Constant(2)));
    std::size_t on_more = 0;
    for (int k = 0; k < 14; ++k) {
      // Diagonals' normals are not whole in 2^20ths: only those through zero are without error.
      Vec3 normal(random.whole(-1, 1), random.whole(-1, 1), random.whole(-1, 1));
      if (normal.isZero()) continue;
      const bool is_axis = normal.cwiseAbs().sum() == 1;
      const Vec3 place = is_axis
                             ? Vec3(random.whole(-1, 1), random.whole(-1, 1), random.whole(-1, 1))
                             : Vec3::Zero();
      split_all(complex, plane_through(place, normal.normalized()));
    }
    check(complex);
    for (std::size_t v = 0; v < complex.vertex_count(); ++v) {
      int planes = 0;
      for (std::size_t p = 0; p < complex.plane_count(); ++p)
        planes += side_of(complex.exact_plane(static_cast<int>(p)),
                          complex.exact_vertex(static_cast<int>(v))) == 0;
      on_more += planes > 3;
    }
    CHECK(on_more > 5);
  }
}

TEST_CASE("the same planes make the same complex") {
  CHECK(numbers_in(random_complex(7, kCellBox, 80)) == numbers_in(random_complex(7, kCellBox, 80)));
  CHECK(numbers_in(random_complex(7, kCellBox, 80)) != numbers_in(random_complex(8, kCellBox, 80)));
}

TEST_CASE("nearly parallel planes keep what must hold") {
  Random random(5);
  for (const double angle : {1e-6, 3e-6, 1e-5, 1e-4}) {
    CellComplex complex(kCellBox);
    for (int k = 0; k < 16; ++k) {
      const Vec3 base = k % 2 == 0 ? Vec3(Vec3::UnitZ()) : Vec3(0.6, 0.8, 0);
      const Vec3 normal = (base + random.uniform(0, angle) * random.direction()).normalized();
      split_all(complex, plane_through(kCellBox.center(), k % 3 == 0 ? Vec3(-normal) : normal));
    }
    check(complex);
    CHECK(complex.cells().size() >= 4);
  }
}

TEST_CASE("wide places, tiny ones and ones far from zero are exact as well") {
  const auto around = [](const Vec3& middle, double half) {
    return Box3(middle - Vec3::Constant(half), middle + Vec3::Constant(half));
  };
  for (const Box3& box :
       {around({0, 0, 0}, 1000), around({400000, 5000000, 100}, 1000), around({-70, 20, 3}, 0.05),
        around({0, 0, 0}, kFarthest), around(Vec3::Constant(kFarthest / 2), 10)}) {
    const CellComplex complex = random_complex(9, box, 60);
    check(complex);
    CHECK(complex.cells().size() > 100);
  }
  error_of(Cause::bad_input, [&] { CellComplex(around({1.1 * kFarthest, 0, 0}, 10)); });
}

TEST_CASE("planes that miss the box by far cut nothing") {
  CellComplex complex(kCellBox);
  for (const double offset : {20.0, -1e6, kFarthest}) {
    const int plane = complex.add_plane({Vec3(1, 2, 3).normalized(), offset}).plane;
    CHECK_FALSE(complex.split(0, plane));
  }
}
