// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/patch_rays.h"

#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

TEST_CASE("rays meet what patches cover, and go through their gaps") {
  LabelledScan scan;
  const int wall = scan.add({0, 0, 0}, {1, 0, 0}, {0, 0, 2});
  scan.add({2, 0, 0}, {1, 0, 0}, {0, 0, 2}, wall);
  scan.add({0, 2, 0}, {3, 0, 0}, {0, 0, 2});
  const PatchRays rays(scan.patches());
  for (double x : {0.1, 0.5, 0.9, 2.1, 2.9}) {
    const auto hit = rays.cast({x, -1, 1}, Vec3::UnitY(), 10);
    REQUIRE(hit.has_value());
    CHECK(hit->patch == 0);
    CHECK(hit->distance == doctest::Approx(1).epsilon(1e-3));
  }
  for (double x : {1.1, 1.5, 1.9}) CHECK(rays.cast({x, -1, 1}, Vec3::UnitY(), 10)->patch == 1);
  CHECK_FALSE(rays.cast({0.5, -1, 1}, Vec3::UnitY(), 0.9).has_value());
  CHECK(rays.cast({0.5, -1, 1}, Vec3::UnitY(), 10, 1.1)->patch == 1);
}

TEST_CASE("the viewer of a place is the nearest viewpoint that nothing hides") {
  LabelledScan scan;
  scan.add({0, 0, 0}, {3, 0, 0}, {0, 0, 2});
  scan.add({0, 2, 0}, {3, 0, 0}, {0, 0, 2});
  const PatchRays rays(scan.patches());
  const std::vector<Vec3> viewpoints = {{1.5, 3, 1}, {1.5, 0.5, 1}, {1.5, -0.3, 1}};
  using Indices = std::vector<std::size_t>;
  CHECK(find_viewers(rays, viewpoints, {1, 0, 1}, 0.05, 1) == Indices{2});
  CHECK(find_viewers(rays, viewpoints, {1, 2, 1}, 0.05, 1) == Indices{0});
  CHECK(find_viewers(rays, {viewpoints[1], viewpoints[1]}, {1, -1, 1}, 0.05, 1).empty());
}
