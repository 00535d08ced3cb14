// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "space/exact.h"

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::space;

namespace {

ExactPlane random_exact_plane(Random& random, double reach, double unit) {
  return exact_plane({random.direction(), random.uniform(-reach, reach)}, unit);
}

}  // namespace

TEST_CASE("a plane in whole numbers is nearly the plane it was, and stays itself from then on") {
  Random random(1);
  for (const double reach : {1.0, 100.0, 3000.0, 3 * kFarthest}) {
    const double unit = unit_for(reach / 4);
    for (int k = 0; k < 1000; ++k) {
      const Plane plane{random.direction(), random.uniform(-reach, reach)};
      const ExactPlane exact = exact_plane(plane, unit);
      CHECK(std::max({std::abs(exact.a), std::abs(exact.b), std::abs(exact.c)}) <= 1 << 20);
      CHECK((exact.plane.normal - plane.normal).norm() < 1e-6);
      CHECK(std::abs(exact.plane.offset - plane.offset) <
            unit / (1 << 20) + 1e-15 * std::abs(plane.offset));
      const ExactPlane again = exact_plane(exact.plane, unit);
      CHECK(again.a == exact.a);
      CHECK(again.b == exact.b);
      CHECK(again.c == exact.c);
      if (std::abs(exact.d) < std::int64_t(1) << 50) CHECK(again.d == exact.d);
      const ExactPlane flipped = exact_plane(plane.flipped(), unit);
      CHECK(flipped.a == -exact.a);
      CHECK(flipped.d == -exact.d);
    }
  }
}

TEST_CASE("planes of one normal that is not quite of length 1 are parallel") {
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0.6, 0, 0.8), Vec3(1, 1, 1)}) {
    const ExactPlane p = exact_plane({normal.normalized(), 0}, 1),
                     q = exact_plane({normal.normalized() * (1 + 1e-5), 0}, 1);
    CHECK(p.a == q.a);
    CHECK(p.b == q.b);
    CHECK(p.c == q.c);
  }
}

TEST_CASE("units are fine in rooms and coarse in wide places") {
  CHECK(unit_for(1) == 0x1p-10);
  CHECK(unit_for(128) == 0x1p-10);
  CHECK(unit_for(129) == 0x1p-9);
  CHECK(unit_for(kFarthest) == 0x1p13);
}

TEST_CASE("three planes meet in a point that is on them, whatever their order") {
  Random random(2);
  for (const double reach : {1.0, 500.0, kFarthest}) {
    // The finest unit too, where numbers are largest.
    for (const double unit : {unit_for(reach / 4), unit_for(0)}) {
      for (int k = 0; k < 1000; ++k) {
        const ExactPlane p = random_exact_plane(random, reach, unit),
                         q = random_exact_plane(random, reach, unit),
                         r = random_exact_plane(random, reach, unit);
        const auto point = meet(p, q, r);
        REQUIRE(point);
        CHECK(point->w > 0);
        for (const ExactPlane* plane : {&p, &q, &r}) CHECK(side_of(*plane, *point) == 0);
        CHECK(*point == *meet(r, q, p));
        CHECK(*point == *meet(q, p, r));
        const Vec3 place = place_of(*point, unit);
        CHECK(std::abs(p.plane.signed_distance(place)) < 1e-14 * (place.norm() + reach));
        // A plane moved by the least there is, is not on it any more.
        ExactPlane moved = p;
        ++moved.d;
        CHECK(side_of(moved, *point) == 1);
        moved.d -= 2;
        CHECK(side_of(moved, *point) == -1);
      }
    }
  }
}

TEST_CASE("planes that are parallel or share a line meet in no point") {
  const ExactPlane x = exact_plane({Vec3::UnitX(), -1}, 0x1p-10),
                   x2 = exact_plane({Vec3::UnitX(), -2}, 0x1p-10),
                   y = exact_plane({Vec3::UnitY(), 0}, 0x1p-10),
                   z = exact_plane({Vec3::UnitZ(), 0}, 0x1p-10),
                   yz = exact_plane({Vec3(0, 1, 1).normalized(), 0}, 0x1p-10);
  CHECK_FALSE(meet(x, x2, y));
  CHECK_FALSE(meet(y, z, yz));
  const auto corner = meet(x, y, z);
  REQUIRE(corner);
  CHECK(side_of(yz, *corner) == 0);
  CHECK(side_of(x2, *corner) == -1);
  CHECK(place_of(*corner, 0x1p-10) == Vec3(1, 0, 0));
}

TEST_CASE("planes that are nearly parallel meet in a point that is told from its neighbours") {
  // Turned against each other by single steps of their numbers.
  const double unit = 0x1p-10;
  const ExactPlane p = exact_plane({Vec3(1, 1e-6, 0).normalized(), -3}, unit);
  const ExactPlane q = exact_plane({Vec3(1, 2e-6, 1e-6).normalized(), -3}, unit);
  const ExactPlane r = exact_plane({Vec3(1, 0, 1e-6).normalized(), -3}, unit);
  const auto point = meet(p, q, r);
  REQUIRE(point);
  for (const ExactPlane* plane : {&p, &q, &r}) CHECK(side_of(*plane, *point) == 0);
  ExactPlane moved = q;
  ++moved.d;
  CHECK(side_of(moved, *point) == 1);
}

TEST_CASE("a plane that is on no planet of ours is an error") {
  const std::string message = error_of(Cause::bad_input, [] {
    exact_plane({Vec3::UnitX(), 5 * kFarthest}, 0x1p-10);
  });
  CHECK(contains(message, "5368709120"));
  error_of(Cause::bad_input, [] { exact_plane({Vec3::UnitX(), NAN}, 0x1p-10); });
}
