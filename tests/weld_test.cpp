// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/weld.h"

#include <Eigen/LU>
#include <set>

#include "support/support.h"
#include "world/assemble.h"
#include "world/cracks.h"
#include "world/validate.h"

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

// The corners of a loop put where their planes meet.
std::vector<Corner> placed(std::vector<Corner> loop, const std::vector<Plane>& planes) {
  for (Corner& corner : loop) {
    Mat3 normals;
    Vec3 offsets;
    for (int k = 0; k < 3; ++k) {
      const Plane& p = planes[static_cast<std::size_t>(corner.planes[static_cast<std::size_t>(k)])];
      normals.row(k) = p.normal.transpose(), offsets[k] = -p.offset;
    }
    corner.at = normals.inverse() * offsets;
  }
  return loop;
}

std::vector<Piece> weld_placed(std::vector<CornerPolygon> polygons,
                               const std::vector<Plane>& planes) {
  for (CornerPolygon& polygon : polygons)
    for (auto& loop : polygon.loops) loop = placed(loop, planes);
  return weld(polygons, planes);
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
  const std::vector<Piece> pieces = weld_placed(both, box_planes());
  CHECK(pieces.size() == 3);
  CHECK(points_of(pieces).size() == 7);  // of three faces at one corner
}

TEST_CASE("where a corner lies on another polygon's edge, that has a vertex there") {
  // The floor, and half of a wall: from x = 0 to 1.5.
  const std::vector<CornerPolygon> polygons = {{4, {loop_along(4, {2, 1, 3, 0})}},
                                               {2, {loop_along(2, {5, 6, 4, 0})}},
                                               {2, {loop_along(2, {0, 4, 6, 5})}}};
  const std::vector<Piece> pieces = weld_placed(polygons, box_planes());
  REQUIRE(pieces.size() == 2);
  CHECK(pieces[0].loops[0].size() == 5);
  CHECK(pieces[1].loops[0].size() == 4);
  const auto& floor = pieces[0].loops[0];
  CHECK(std::count(floor.begin(), floor.end(), Vec3(1.5, 0, 0)) == 1);
}

TEST_CASE("corners some millimetres apart are one") {
  for (const auto& [shift, is_one] : {std::pair{0.0004, true}, {0.004, true}, {0.007, false}}) {
    std::vector<Plane> planes = box_planes();
    planes.push_back({-Vec3::UnitX(), 3 + shift});
    const std::vector<Piece> pieces = weld_placed({{4, {loop_along(4, {2, 1, 3, 0})}},
                                                   {2, {loop_along(2, {4, 0, 5, 7})}},
                                                   {2, {loop_along(2, {7, 5, 0, 4})}}},
                                                  planes);
    REQUIRE(pieces.size() == 2);
    CHECK((points_of(pieces).size() == 6) == is_one);
  }
}

TEST_CASE("faces that end some millimetres off each other close up, and stay in their planes") {
  Random random(1);
  for (int round = 0; round < 200; ++round) {
    // Each face of a box ends at planes of its own, near the other faces, and may lean a little.
    std::vector<Plane> planes = box_planes();
    planes.pop_back();
    for (Plane& p : planes) p.normal = (p.normal + 0.01 * random.direction()).normalized();
    std::vector<CornerPolygon> faces;
    for (int face = 0; face < 6; ++face) {
      std::vector<int> around;
      for (int k : face < 2   ? std::array{2, 5, 3, 4}
                   : face < 4 ? std::array{4, 1, 5, 0}
                              : std::array{0, 3, 1, 2}) {
        around.push_back(static_cast<int>(planes.size()));
        planes.push_back(planes[static_cast<std::size_t>(k)]);
        planes.back().offset += random.uniform(-0.0015, 0.0015);
      }
      if (face % 2 == 1) std::reverse(around.begin(), around.end());
      std::vector<Corner> loop = loop_along(face, around);
      faces.push_back({face, {loop}});
      std::reverse(loop.begin(), loop.end());
      for (std::size_t k = 0; k < loop.size(); ++k) loop[k].next = around[(6 - k) % 4];
      faces.push_back({face, {loop}});  // one of the two ways round is no polygon
    }
    std::vector<FoundSurface> found;
    for (const Piece& piece : weld_placed(faces, planes)) {
      const Plane& plane = planes[static_cast<std::size_t>(piece.patch)];
      for (const Vec3& p : piece.loops[0]) CHECK(std::abs(plane.signed_distance(p)) < 0.00095);
      found.push_back({.plane = plane, .outer = piece.loops[0]});
    }
    const World world = assemble_world(found, {});
    CHECK(world.surfaces.size() == 6);
    CHECK(world.vertices.size() == 8);
    CHECK(validate(world).empty());
    CHECK(find_cracks(world).empty());
  }
}

TEST_CASE("an edge passes through the corner of another that goes along it, though off its line") {
  // The wall y = 0 stands on the floor from x = 0 to 1.5 and ends at a plane that leans by 2 mm.
  std::vector<Plane> planes = box_planes();
  planes.push_back(plane_through({0, 0.002, 0}, Vec3(0, 1, 0)));
  const std::vector<Piece> pieces = weld_placed({{4, {loop_along(4, {7, 1, 3, 0})}},
                                                 {4, {loop_along(4, {0, 3, 1, 7})}},
                                                 {2, {loop_along(2, {5, 6, 4, 0})}},
                                                 {2, {loop_along(2, {0, 4, 6, 5})}}},
                                                planes);
  std::vector<FoundSurface> found;
  for (const Piece& piece : pieces)
    found.push_back(
        {.plane = planes[static_cast<std::size_t>(piece.patch)], .outer = piece.loops[0]});
  CHECK(find_cracks(assemble_world(found, {})).empty());
}
