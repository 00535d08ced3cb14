// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "space/evidence.h"
#include "support/cells.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// A plane that cuts what a rectangle touches.
space::SpacePlane cutting(const Vec3& corner, const Vec3& a, const Vec3& b,
                          space::SpacePlane::Kind kind = space::SpacePlane::Kind::surface) {
  return {.plane = plane_through(corner, a.cross(b).normalized()),
          .kind = kind,
          .patch = kind == space::SpacePlane::Kind::surface ? 0 : -1,
          .size = a.cross(b).norm(),
          .regions = {{corner, corner + a, corner + a + b, corner + b}}};
}

const space::ArrangeOptions kNoPad{.pad = 0};

std::size_t count_cells(const std::vector<space::SpacePlane>& planes) {
  const space::Arrangement arrangement = space::arrange(planes, kCellBox, kNoPad);
  check(arrangement.cells);
  return arrangement.cells.cells().size();
}

// Upright across the middle of the box in x, level through one half of it.
const space::SpacePlane kUpright = cutting({1, -2, -1}, {0, 6, 0}, {0, 0, 3});
const space::SpacePlane kLevel = cutting({2, 0, 0}, {1, 0, 0}, {0, 1, 0});

std::vector<space::SpacePlane> random_planes(std::uint64_t seed) {
  Random random(seed);
  std::vector<space::SpacePlane> planes;
  for (int k = 0; k < 40; ++k) {
    const Vec3 normal = k % 3 == 0 ? Vec3(Vec3::Unit(random.whole(0, 2))) : random.direction();
    const Vec3 middle = random_place(random, kCellBox);
    const auto region = random_rectangle(random, middle, normal, random.uniform(0.2, 2));
    planes.push_back({.plane = plane_through(middle, normal),
                      .patch = k,
                      .size = area_of(region),
                      .regions = {region}});
  }
  return planes;
}

}  // namespace

TEST_CASE("a plane cuts the whole cells that it touches, and no others") {
  CHECK(count_cells({}) == 1);
  CHECK(count_cells({kUpright}) == 2);
  CHECK(count_cells({kUpright, kLevel}) == 3);
  CHECK(count_cells({kLevel, kUpright}) == 4);  // in the order given: first the whole box
  const space::Arrangement arrangement = space::arrange({kUpright, kLevel}, kCellBox, kNoPad);
  double area = 0;
  for (const space::CellFacet& f : arrangement.cells.facets())
    if (f.plane == space::CellComplex::kBoxPlanes + 1) area += arrangement.cells.area_of(f);
  CHECK(area == doctest::Approx(4 * 6));  // far more than touched
}

TEST_CASE(
    "what is touched too little is left whole, unless that is much of the plane or the cell") {
  // All to the right, and a tongue 20 cm wide that reaches to the left.
  const auto sliver = [](double width, auto... kind) {
    space::SpacePlane plane = cutting({1, -1, 0}, {2, 0, 0}, {0, 3, 0}, kind...);
    plane.regions.push_back(cutting({1 - width, 0, 0}, {width, 0, 0}, {0, 0.2, 0}).regions[0]);
    return plane;
  };
  CHECK(count_cells({kUpright, sliver(0.05)}) == 3);
  CHECK(count_cells({kUpright, sliver(0.15)}) == 4);
  CHECK(count_cells({kUpright, sliver(0.003, space::SpacePlane::Kind::edge)}) == 3);
  CHECK(count_cells({kUpright, sliver(0.05, space::SpacePlane::Kind::edge)}) == 4);
  // A patch of 0.01 m2 is small, but all there is.
  CHECK(count_cells({cutting({0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0})}) == 2);
  // A layer 1 mm thick is crossed by no more than a strip.
  const space::SpacePlane below = cutting({-3, -2, 0}, {8, 0, 0}, {0, 6, 0}),
                          above = cutting({-3, -2, 0.001}, {8, 0, 0}, {0, 6, 0}),
                          across = cutting({1, -2, -1}, {0, 6, 0}, {0, 0, 3});
  CHECK(count_cells({below, above, across}) == 6);
}

TEST_CASE("a plane that is there twice cuts once, and both are parts of it") {
  space::SpacePlane back = kUpright;
  back.plane = back.plane.flipped();
  const space::SpacePlane nothing{.plane = kLevel.plane, .regions = {}};
  const space::Arrangement arrangement =
      space::arrange({kUpright, nothing, back, kLevel}, kCellBox, kNoPad);
  CHECK(arrangement.cells.cells().size() == 3);
  REQUIRE(arrangement.parts.size() == space::CellComplex::kBoxPlanes + 2);
  for (int p = 0; p < space::CellComplex::kBoxPlanes; ++p)
    CHECK(arrangement.parts[static_cast<std::size_t>(p)].empty());
  const auto &first = arrangement.parts[space::CellComplex::kBoxPlanes],
             &second = arrangement.parts[space::CellComplex::kBoxPlanes + 1];
  REQUIRE(first.size() == 2);
  CHECK(first[0].plane == 0);
  CHECK(first[1].plane == 2);
  CHECK(first[0].is_flipped != first[1].is_flipped);
  REQUIRE(second.size() == 1);
  CHECK(second[0].plane == 3);
}

TEST_CASE("the whole is larger than what it is made around by the pad") {
  const space::Arrangement arrangement = space::arrange({kUpright}, kCellBox, {.pad = 0.5});
  double volume = 0;
  for (std::size_t c = 0; c < arrangement.cells.cells().size(); ++c)
    volume += arrangement.cells.volume_of(static_cast<int>(c));
  CHECK(volume == doctest::Approx(grown(kCellBox, 0.5).volume()));
}

TEST_CASE("nothing of a region is left inside a cell, but what is too little to cut") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const std::vector<space::SpacePlane> planes = random_planes(seed);
    const space::Arrangement arrangement = space::arrange(planes, kCellBox, kNoPad);
    check(arrangement.cells);
    CHECK(arrangement.cells.cells().size() > 100);
    for (const space::SpacePlane& p : planes) {
      std::map<int, double> left;
      arrangement.cells.clip(p.regions[0], [&](int cell, const std::vector<Vec3>& part) {
        // Beyond the box its outer cells go on.
        for (const Vec3& corner : part)
          if (!grown(kCellBox, 1e-3).contains(corner)) return;
        // Planes are rounded: what is left of one that cut is off it by less than 1e-5.
        const space::Cell& own = arrangement.cells.cells()[static_cast<std::size_t>(cell)];
        for (const int f : own.facets) {
          const Plane& side = arrangement.cells.plane(
              arrangement.cells.facets()[static_cast<std::size_t>(f)].plane);
          if (std::all_of(part.begin(), part.end(), [&](const Vec3& corner) {
                return std::abs(side.signed_distance(corner)) < 1e-4;
              }))
            return;
        }
        left[cell] += area_of(part);
      });
      for (const auto& [cell, area] : left) CHECK(area < 0.02);
    }
  }
}
