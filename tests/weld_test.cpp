// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/weld.h"

#include <set>

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

namespace {

// The planes of a box from the origin to (3, 2, 1): x = 0, x = 3, y = 0, y = 2, z = 0, z = 1, and
// x = 1.5 through its middle.
std::vector<Plane> box_planes() {
  return {{Vec3::UnitX(), 0}, {-Vec3::UnitX(), 3}, {Vec3::UnitY(), 0},   {-Vec3::UnitY(), 2},
          {Vec3::UnitZ(), 0}, {-Vec3::UnitZ(), 1}, {Vec3::UnitX(), -1.5}};
}

// A loop in plane `own` whose edges run along these planes.
std::vector<Corner> loop_along(int own, const std::vector<int>& planes) {
  std::vector<Corner> loop;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    Corner corner{{own, planes[(k + planes.size() - 1) % planes.size()], planes[k]}, planes[k], {}};
    std::sort(corner.planes.begin(), corner.planes.end());
    loop.push_back(corner);
  }
  return loop;
}

using Points = std::set<std::array<double, 3>>;

Points points_of(const std::vector<Piece>& pieces) {
  Points points;
  for (const Piece& piece : pieces)
    for (const auto& loop : piece.loops)
      for (const Vec3& p : loop) points.insert({p.x(), p.y(), p.z()});
  return points;
}

}  // namespace

TEST_CASE("the faces of a box have eight corners together") {
  const std::vector<CornerPolygon> faces = {{0, {loop_along(0, {2, 5, 3, 4})}},
                                            {4, {loop_along(4, {2, 1, 3, 0})}},
                                            {2, {loop_along(2, {4, 0, 5, 1})}}};
  std::vector<CornerPolygon> turned = faces;
  for (auto& face : turned)
    for (auto& loop : face.loops) {
      std::vector<int> back;
      for (auto corner = loop.rbegin(); corner != loop.rend(); ++corner)
        back.push_back(corner->next);
      loop = loop_along(face.patch, back);
    }
  // One of the two ways round is counter-clockwise; the other one is no polygon.
  std::vector<CornerPolygon> both = faces;
  both.insert(both.end(), turned.begin(), turned.end());
  const std::vector<Piece> pieces = weld(both, box_planes());
  CHECK(pieces.size() == 3);
  CHECK(points_of(pieces).size() == 7);  // of three faces at one corner
}

TEST_CASE("where a corner lies on another polygon's edge, that has a vertex there") {
  // The floor, and half of a wall: from x = 0 to 1.5.
  const std::vector<CornerPolygon> polygons = {{4, {loop_along(4, {2, 1, 3, 0})}},
                                               {2, {loop_along(2, {5, 6, 4, 0})}},
                                               {2, {loop_along(2, {0, 4, 6, 5})}}};
  const std::vector<Piece> pieces = weld(polygons, box_planes());
  REQUIRE(pieces.size() == 2);
  CHECK(pieces[0].loops[0].size() == 5);
  CHECK(pieces[1].loops[0].size() == 4);
  const auto& floor = pieces[0].loops[0];
  CHECK(std::count(floor.begin(), floor.end(), Vec3(1.5, 0, 0)) == 1);
}

TEST_CASE("corners a millimetre apart are one, unless that takes them off their planes") {
  for (const auto& [shift, vertices] : {std::pair{0.0004, 7u}, {0.0012, 9u}}) {
    std::vector<Plane> planes = box_planes();
    planes.push_back({-Vec3::UnitX(), 3 + shift});
    const std::vector<Piece> pieces = weld({{4, {loop_along(4, {2, 1, 3, 0})}},
                                            {2, {loop_along(2, {4, 0, 5, 7})}},
                                            {2, {loop_along(2, {7, 5, 0, 4})}}},
                                           planes);
    REQUIRE(pieces.size() == 2);
    CHECK(points_of(pieces).size() >= 6);
    CHECK(points_of(pieces).size() <= vertices);
    const bool is_one = points_of(pieces).size() == 6;
    CHECK(is_one == (shift < 0.0005));
  }
}
