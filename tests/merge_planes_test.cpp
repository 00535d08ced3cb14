// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/merge_planes.h"

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

namespace {

// A floor, plane 0, from x = 0 to 4 that is cut by y = 0, x = 4, y = 3 and plane `last` on the
// left, at x = left.
CornerPolygon floor_to(int last, double left = 0) {
  CornerPolygon floor{.patch = 0, .loops = {{}}};
  const std::array<int, 4> lines = {1, 2, 3, last};
  const std::array<Vec3, 4> at = {Vec3(left, 0, 0), Vec3(4, 0, 0), Vec3(4, 3, 0), Vec3(left, 3, 0)};
  for (std::size_t k = 0; k < 4; ++k) {
    Corner corner{{0, lines[(k + 3) % 4], lines[k]}, lines[k], at[k]};
    std::sort(corner.planes.begin(), corner.planes.end());
    floor.loops[0].push_back(corner);
  }
  return floor;
}

// A wall in plane 4, x = 0, that is cut by z = 0 (the floor), y = 3, z = 2 and y = 0.
CornerPolygon wall_corners() {
  CornerPolygon wall{.patch = 4, .loops = {{}}};
  const std::array<int, 4> lines = {0, 3, 5, 1};
  const std::array<Vec3, 4> at = {Vec3(0, 0, 0), Vec3(0, 3, 0), Vec3(0, 3, 2), Vec3(0, 0, 2)};
  for (std::size_t k = 0; k < 4; ++k) {
    Corner corner{{4, lines[(k + 3) % 4], lines[k]}, lines[k], at[k]};
    std::sort(corner.planes.begin(), corner.planes.end());
    wall.loops[0].push_back(corner);
  }
  return wall;
}

std::vector<Plane> planes_with(const Plane& seventh) {
  return {{Vec3::UnitZ(), 0},
          {Vec3::UnitY(), 0},
          {-Vec3::UnitX(), 4},
          {-Vec3::UnitY(), 3},
          {Vec3::UnitX(), 0},
          {-Vec3::UnitZ(), 2},
          seventh};
}

}  // namespace

TEST_CASE("a plane that only cuts, near a polygon's, is that one") {
  for (const auto& [left, name] : {std::pair{0.003, 4}, {-0.0045, 4}, {0.006, 6}}) {
    const auto names =
        merge_planes({floor_to(6, left), wall_corners()}, planes_with({Vec3::UnitX(), -left}), {});
    CHECK(names[6] == name);
    for (int k = 0; k < 6; ++k) CHECK(names[static_cast<std::size_t>(k)] == k);
  }
}

TEST_CASE("planes at an angle are never one, though the corners of an edge are near both") {
  const Vec3 slope = Vec3(1, 0, 1).normalized();
  CHECK(merge_planes({floor_to(6), wall_corners()}, planes_with({slope, 0}), {})[6] == 6);
}

TEST_CASE("the planes of two polygons are one only where they hardly differ") {
  for (const auto& [off, is_one] : {std::pair{0.0003, true}, {0.002, false}}) {
    CornerPolygon other = wall_corners();
    other.patch = 6;
    for (Corner& corner : other.loops[0]) {
      corner.at.x() += off;
      for (int& plane : corner.planes)
        if (plane == 4) plane = 6;
      std::sort(corner.planes.begin(), corner.planes.end());
    }
    const auto names =
        merge_planes({floor_to(4), wall_corners(), other}, planes_with({Vec3::UnitX(), -off}), {});
    CHECK((names[6] == 4) == is_one);
    for (Corner& corner : other.loops[0]) corner.at.y() += 10;  // elsewhere
    CHECK(merge_planes({floor_to(4), wall_corners(), other}, planes_with({Vec3::UnitX(), -off}),
                       {})[6] == 6);
  }
}
