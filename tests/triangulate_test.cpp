// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/triangulate.h"

#include <map>
#include <set>

#include "support/scenes.h"
#include "world/assemble.h"
#include "world/validate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// What must hold of the triangles of any valid world.
void check_mesh(const World& world) {
  const WorldMesh m = triangulate(world);
  REQUIRE(m.mesh.triangles.size() == m.surface.size());
  std::vector<double> areas(world.surfaces.size());
  std::vector<std::set<int>> used(world.surfaces.size());
  for (std::size_t t = 0; t < m.surface.size(); ++t) {
    const auto at = [&](std::size_t k) {
      return m.mesh.vertices[static_cast<std::size_t>(m.mesh.triangles[t][k])];
    };
    const std::size_t s = static_cast<std::size_t>(m.surface[t]);
    const Vec3 doubled = (at(1) - at(0)).cross(at(2) - at(0));
    CHECK(doubled.dot(world.surfaces[s].plane.normal) > 0);  // the right side up
    areas[s] += doubled.norm() / 2;
    for (int v : m.mesh.triangles[t]) used[s].insert(v);
  }
  for (std::size_t s = 0; s < areas.size(); ++s) {
    CHECK(areas[s] == doctest::Approx(area(world, world.surfaces[s])).scale(0).epsilon(1e-6));
    std::set<int> loops(world.surfaces[s].outer.begin(), world.surfaces[s].outer.end());
    for (const Loop& h : world.surfaces[s].holes) loops.insert(h.begin(), h.end());
    CHECK(used[s] == loops);  // every vertex, so that neighbours meet in shared edges
  }
}

std::vector<Vec3> lifted(const PlaneFrame& frame, const std::vector<Vec2>& ring) {
  std::vector<Vec3> points;
  for (const Vec2& p : ring) points.push_back(frame.to_space(p));
  return points;
}

}  // namespace

TEST_CASE("holes stay open and areas are kept") {
  check_mesh({});
  check_mesh(small_world());
  for (const char* name : {"room", "office", "stairs"})
    check_mesh(read_world(in_project(std::string("worlds/") + name + ".json")));
}

TEST_CASE(
    "random polygons with holes, and with vertices on straight edges, in planes turned at random") {
  Random random(1);
  int tried = 0;
  for (int round = 0; round < 600; ++round) {
    const Plane plane = plane_through(5 * random.direction(), random.direction());
    const PlaneFrame frame = frame_of(plane);
    std::vector<Vec2> outer;
    const int corners = random.whole(3, 12);
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * M_PI * (i + random.uniform(0, 0.5)) / corners,
                   radius = random.uniform(3, 6);
      outer.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
      if (random.whole(0, 2) == 0 && outer.size() > 1)
        outer.insert(outer.end() - 1, (outer.end()[-1] + outer.end()[-2]) / 2);
    }
    FoundSurface found{.plane = plane, .outer = lifted(frame, outer)};
    for (int h = 0; h < random.whole(0, 3); ++h) {
      const Vec2 c(-1.2 + 1.2 * h, random.uniform(-0.3, 0.3));
      const double w = random.uniform(0.1, 0.5), t = random.uniform(0.1, 0.5);
      found.holes.push_back(lifted(frame, {c + Vec2(-w, -t), c + Vec2(-w, t), c + Vec2(0, t),
                                           c + Vec2(w, t), c + Vec2(w, -t)}));
    }
    const World world = assemble_world({found}, {});
    if (!validate(world).empty()) continue;
    ++tried;
    check_mesh(world);
  }
  CHECK(tried > 300);
}

TEST_CASE("neighbours of the worlds that come with the program meet without gaps") {
  // Every edge inside the building belongs to two triangles; open are only the rims of windows and
  // doors to the outside and of things that stand on the floor.
  const World world = read_world(in_project("worlds/room.json"));
  const WorldMesh m = triangulate(world);
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : m.mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      ++edges[{std::min(a, b), std::max(a, b)}];
    }
  double open_inside = 0;
  for (const auto& [edge, count] : edges) {
    if (count != 1) continue;
    const Vec3 a = m.mesh.vertices[static_cast<std::size_t>(edge.first)],
               b = m.mesh.vertices[static_cast<std::size_t>(edge.second)];
    const Vec3 middle = (a + b) / 2;
    const bool outer_rim = middle.y() < -0.29 || middle.x() > 5.09;
    const bool on_floor =
        middle.z() < 1e-6 || middle.z() > 0.6;  // furniture stands on floor and table top
    if (!outer_rim && !(on_floor && middle.x() > 0.01 && middle.x() < 4.99 && middle.y() > 0.01 &&
                        middle.y() < 3.99))
      open_inside += (a - b).norm();
  }
  CHECK(open_inside == 0);
}

TEST_CASE("a surface that is no polygon is named") {
  World world = small_world();
  std::swap(world.surfaces[0].outer[0], world.surfaces[0].outer[1]);
  CHECK(contains(error_of(Cause::check_failed, [&] { triangulate(world); }), "surface 0"));
}
