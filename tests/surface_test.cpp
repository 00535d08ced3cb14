// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/surface.h"

#include <map>

#include "polygon.h"
#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

namespace {

std::vector<Piece> pieces_of(const LabelledScan& scan) {
  const std::vector<Patch> patches = scan.weighed_patches();
  const std::vector<Seam> seams = find_seams(patches);
  const auto lines = lines_of(patches, seams);
  const auto edges =
      share_edges(find_free_edges(scan.cloud, scan.members(), patches, lines), patches, seams);
  const Pieces pieces = add_reveals(outline_patches(patches, lines, edges));
  return weld(pieces.polygons, pieces.planes);
}

// A room from the origin, seen from inside.
void add_room(LabelledScan& scan, const Vec3& size) {
  const Vec3 x = Vec3::UnitX() * size.x(), y = Vec3::UnitY() * size.y(),
             z = Vec3::UnitZ() * size.z();
  scan.add(Vec3::Zero(), x, y);
  scan.add(z, y, x);
  scan.add(Vec3::Zero(), z, x);
  scan.add(y, x, z);
  scan.add(Vec3::Zero(), y, z);
  scan.add(x, z, y);
}

using Edge = std::array<double, 6>;

// How often each edge is there, whichever way it goes.
std::map<Edge, int> edges_of(const std::vector<Piece>& pieces) {
  std::map<Edge, int> count;
  for (const Piece& piece : pieces)
    for (const auto& loop : piece.loops)
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec3 &p = loop[k], &q = loop[(k + 1) % loop.size()];
        const Edge there = {p.x(), p.y(), p.z(), q.x(), q.y(), q.z()},
                   back = {q.x(), q.y(), q.z(), p.x(), p.y(), p.z()};
        ++count[std::min(there, back)];
      }
  return count;
}

// Corners that lie on an edge of another polygon which has no vertex there.
int count_junctions(const std::vector<Piece>& pieces) {
  int count = 0;
  const std::map<Edge, int> edges = edges_of(pieces);
  for (const Piece& piece : pieces)
    for (const auto& loop : piece.loops)
      for (const Vec3& v : loop)
        for (const auto& [e, n] : edges) {
          const Vec3 p(e[0], e[1], e[2]), q(e[3], e[4], e[5]);
          const double length = (q - p).norm(), t = (v - p).dot(q - p) / length;
          if (t > 0.003 && t < length - 0.003 && (p + (q - p) * (t / length) - v).norm() < 0.001)
            ++count;
        }
  return count;
}

// Whether a polygon in a plane with this normal covers a point.
bool is_covered(const std::vector<Piece>& pieces, const Vec3& p, const Vec3& normal) {
  return std::any_of(pieces.begin(), pieces.end(), [&](const Piece& piece) {
    const auto& outer = piece.loops[0];
    Vec3 own = Vec3::Zero();
    for (std::size_t k = 0; k < outer.size(); ++k)
      own += (outer[k] - outer[0]).cross(outer[(k + 1) % outer.size()] - outer[0]);
    own.normalize();
    if (std::abs(own.dot(normal)) < 0.99 || std::abs(own.dot(p - outer[0])) > 0.05) return false;
    const PlaneFrame frame = frame_of(plane_through(outer[0], own));
    std::vector<std::vector<Vec2>> loops;
    for (const auto& loop : piece.loops) {
      loops.emplace_back();
      for (const Vec3& v : loop) loops.back().push_back(frame.to_plane(v));
    }
    return is_inside(loops, frame.to_plane(p));
  });
}

// Two rooms and the wall between them, 15 cm thick, with a doorway from x = 1.5 to 2.4, 2 m high.
LabelledScan two_rooms() {
  LabelledScan scan;
  const int floor = scan.add({0, 0, 0}, {4, 0, 0}, {0, 3, 0});
  scan.add({0, 3.15, 0}, {4, 0, 0}, {0, 3, 0}, floor);
  scan.add({1.5, 3, 0}, {0.9, 0, 0}, {0, 0.15, 0}, floor);
  for (double y : {3.0, 3.15}) {
    const Vec3 up = Vec3::UnitZ();
    const int wall = scan.add({0, y, 0}, 2.5 * up, {1.5, 0, 0});
    scan.add({2.4, y, 0}, 2.5 * up, {1.6, 0, 0}, wall);
    scan.add({1.5, y, 2}, 0.5 * up, {0.9, 0, 0}, wall);
  }
  scan.add({0, 0, 0}, {0, 6.15, 0}, {0, 0, 2.5});
  scan.add({4, 0, 0}, {0, 0, 2.5}, {0, 6.15, 0});
  scan.add({0, 0, 0}, {0, 0, 2.5}, {4, 0, 0});
  scan.add({0, 6.15, 0}, {4, 0, 0}, {0, 0, 2.5});
  scan.cloud.viewpoints = {Vec3(2, 1, 1.5), Vec3(2, 5, 1.5)};
  return scan;
}

}  // namespace

TEST_CASE("a room is closed: six polygons whose edges each belong to two of them") {
  LabelledScan scan;
  add_room(scan, {5, 4, 2.7});
  scan.cloud.viewpoints = {Vec3(2, 2, 1.5)};
  const std::vector<Piece> pieces = pieces_of(scan);
  CHECK(pieces.size() == 6);
  const auto edges = edges_of(pieces);
  CHECK(edges.size() == 12);
  for (const auto& [edge, count] : edges) CHECK(count == 2);
}

TEST_CASE("a doorway stays open, the floor goes through it and ends at the walls beside it") {
  const std::vector<Piece> pieces = pieces_of(two_rooms());
  for (double y : {3.0, 3.15}) {
    for (double x : {1.53, 1.95, 2.37})
      for (double z : {0.05, 1.0, 1.95}) CHECK_FALSE(is_covered(pieces, {x, y, z}, Vec3::UnitY()));
    for (double x : {1.4, 2.5}) CHECK(is_covered(pieces, {x, y, 1}, Vec3::UnitY()));
    CHECK(is_covered(pieces, {1.95, y, 2.05}, Vec3::UnitY()));
  }
  CHECK(is_covered(pieces, {1.95, 3.075, 0}, Vec3::UnitZ()));
  CHECK_FALSE(is_covered(pieces, {1.0, 3.075, 0}, Vec3::UnitZ()));
  CHECK_FALSE(is_covered(pieces, {3.0, 3.075, 0}, Vec3::UnitZ()));
}

TEST_CASE("a doorway is closed all around between the faces of its wall") {
  int around = 0;
  for (const auto& [e, count] : edges_of(pieces_of(two_rooms()))) {
    const Vec3 p(e[0], e[1], e[2]), q(e[3], e[4], e[5]), middle = (p + q) / 2;
    if (!Box3(Vec3(1.45, 2.95, 0.01), Vec3(2.45, 3.2, 2.05)).contains(middle)) continue;
    ++around;
    CHECK(count == 2);
  }
  CHECK(around == 8);
}

TEST_CASE("no corner lies on an edge that has no vertex there") {
  CHECK(count_junctions(pieces_of(two_rooms())) == 0);
}

TEST_CASE("a wall goes on behind a cupboard, down to the floor") {
  LabelledScan scan;
  scan.add({0, 0.6, 0}, {4, 0, 0}, {0, 2, 0});
  scan.add({0, 0, 0}, {1, 0, 0}, {0, 0.6, 0}, 0);
  scan.add({2.2, 0, 0}, {1.8, 0, 0}, {0, 0.6, 0}, 0);
  const int wall = scan.add({0, 0, 0}, {0, 0, 2.5}, {1, 0, 0});
  scan.add({2.2, 0, 0}, {0, 0, 2.5}, {1.8, 0, 0}, wall);
  scan.add({1, 0, 1.8}, {0, 0, 0.7}, {1.2, 0, 0}, wall);
  scan.add({1, 0.6, 0}, {0, 0, 1.8}, {1.2, 0, 0});
  scan.add({1, 0, 1.8}, {1.2, 0, 0}, {0, 0.6, 0});
  scan.add({1, 0, 0}, {0, 0.6, 0}, {0, 0, 1.8});
  scan.add({2.2, 0, 0}, {0, 0, 1.8}, {0, 0.6, 0});
  scan.cloud.viewpoints = {Vec3(1.6, 2.4, 1.5)};
  const std::vector<Piece> pieces = pieces_of(scan);
  CHECK(is_covered(pieces, {1.6, 0, 0.5}, Vec3::UnitY()));
  CHECK(is_covered(pieces, {1.6, 0, 1.6}, Vec3::UnitY()));
}

TEST_CASE("every option of the polygons has a unit or is a share, and can be set") {
  SurfaceOptions options;
  const OptionList list = list_options(options);
  set_option(list, "surface.seams.gap", "0.25");
  CHECK(options.seams.gap == 0.25);
  for (const Option& option : list) CHECK(option.name.starts_with("surface."));
}
