// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/seen_space.h"

#include "support/scenes.h"
#include "world/assemble.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// A level floor, and a ceiling of the same extent, 3 m by 3 m.
World floor_and_ceiling() {
  FoundSurface floor, ceiling;
  floor.outer = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}};
  ceiling.plane = {-Vec3::UnitZ(), 2.5};
  ceiling.outer = {{0, 3, 2.5}, {3, 3, 2.5}, {3, 0, 2.5}, {0, 0, 2.5}};
  return assemble_world({floor, ceiling}, {});
}

// Their points, and those of a plate in the middle at a height, which hides some of each.
PointCloud points_with_plate(double height) {
  std::vector<Vec3> points;
  for (double x = 0.02; x < 3; x += 0.04)
    for (double y = 0.02; y < 3; y += 0.04) {
      for (double z : {0.0, 2.5}) points.emplace_back(x, y, z);
      if (std::abs(x - 1.5) < 0.7 && std::abs(y - 1.5) < 0.7) points.emplace_back(x, y, height);
    }
  return cloud_of(points);
}

bool is_seen(const SeenSpace& seen, const Vec3& p) {
  return seen.contains((p / seen.cell).array().floor().cast<int>());
}

const Box3 kEverywhere(Vec3(-1, -1, -1), Vec3(4, 4, 4));

}  // namespace

TEST_CASE("what is between a viewpoint and the points that it saw is free, what is behind is not") {
  PointCloud cloud = points_with_plate(1.25);
  cloud.viewpoints = {{0.3, 0.3, 1.85}};
  const SeenSpace seen = find_seen_space(cloud, floor_and_ceiling(), kEverywhere, 0.1);
  CHECK(is_seen(seen, {0.5, 0.5, 1.55}));
  CHECK_FALSE(is_seen(seen, {0.5, 0.5, -0.55}));
  CHECK_FALSE(is_seen(seen, {1.5, 1.5, 1.25}));
}

TEST_CASE("surfaces that face each other see what is between them, but through no points") {
  const SeenSpace seen =
      find_seen_space(points_with_plate(0.35), floor_and_ceiling(), kEverywhere, 0.1);
  CHECK(is_seen(seen, {0.35, 0.35, 1.25}));
  CHECK_FALSE(is_seen(seen, {1.5, 1.5, 0.35}));
  CHECK(is_seen(seen, {2.65, 1.55, 1.25}));
}

TEST_CASE("only what is in the box is looked at") {
  PointCloud cloud = points_with_plate(1.25);
  cloud.viewpoints = {{0.3, 0.3, 1.85}};
  const Box3 corner(Vec3(0, 0, 1), Vec3(1, 1, 2));
  const SeenSpace seen = find_seen_space(cloud, floor_and_ceiling(), corner, 0.1);
  const auto all = seen.in(kEverywhere);
  CHECK(!all.empty());
  for (const Vec3& p : all) CHECK(grown(corner, 0.11).contains(p));
}
