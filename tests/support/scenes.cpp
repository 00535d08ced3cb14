// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "scenes.h"

#include <numeric>

#include "world/assemble.h"

namespace scanworld::test {

void add_rectangle(PointCloud& cloud, const Vec3& corner, const Vec3& a, const Vec3& b,
                   double spacing, double noise, Random& random) {
  const Vec3 normal = a.cross(b).normalized();
  const int rows = static_cast<int>(a.norm() / spacing),
            columns = static_cast<int>(b.norm() / spacing);
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < columns; ++k) {
      const double s = (i + random.uniform()) / rows, t = (k + random.uniform()) / columns;
      cloud.points.push_back(
          (corner + s * a + t * b + noise * random.gauss() * normal).cast<float>());
    }
}

PointCloud room_points(const Vec3& size, double spacing, double noise, std::uint64_t seed) {
  PointCloud cloud;
  Random random(seed);
  const Vec3 x = Vec3::UnitX() * size.x(), y = Vec3::UnitY() * size.y(),
             z = Vec3::UnitZ() * size.z(), o = Vec3::Zero();
  add_rectangle(cloud, o, x, y, spacing, noise, random);
  add_rectangle(cloud, z, x, y, spacing, noise, random);
  add_rectangle(cloud, o, x, z, spacing, noise, random);
  add_rectangle(cloud, y, x, z, spacing, noise, random);
  add_rectangle(cloud, o, y, z, spacing, noise, random);
  add_rectangle(cloud, x, y, z, spacing, noise, random);
  return cloud;
}

PointCloud cloud_of(const std::vector<Vec3>& points) {
  PointCloud cloud;
  for (const Vec3& p : points) cloud.points.push_back(p.cast<float>());
  return cloud;
}

void shuffle_points(PointCloud& cloud, std::uint64_t seed) {
  Random random(seed), again(seed);
  shuffle(cloud.points, random);
  shuffle(cloud.viewers, again);
}

FoundSurface level_rectangle(double x0, double y0, double x1, double y1, double height) {
  return {.plane = plane_through({0, 0, height}, Vec3::UnitZ()),
          .outer = {{x0, y0, height}, {x1, y0, height}, {x1, y1, height}, {x0, y1, height}}};
}

FoundSurface upright_rectangle(const Vec3& from, const Vec3& to, double height) {
  const Vec3 up = height * Vec3::UnitZ();
  return {.plane = plane_through(from, up.cross(to - from).normalized()),
          .outer = {from, from + up, to + up, to}};
}

World world_with(const std::vector<FoundSurface>& surfaces) { return assemble_world(surfaces, {}); }

World small_world() {
  FoundSurface floor{.plane = {Vec3::UnitZ(), 0},
                     .outer = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}}};
  FoundSurface wall{.plane = {Vec3::UnitY(), 0},
                    .outer = {{0, 0, 0}, {0, 0, 2.5}, {4, 0, 2.5}, {4, 0, 0}},
                    .holes = {{{1, 0, 1}, {2, 0, 1}, {2, 0, 2}, {1, 0, 2}}}};
  return assemble_world({floor, wall}, {});
}

World full_world() {
  World world = small_world();
  world.frame.origin = Vec3(5.5e6, -1234.5, 1.0 / 3);
  world.frame.assumed = {"metres", "a \"quoted\" word, a tab\t and \xc3\xa4"};
  world.surfaces[0].support = {123456789, 0.1, 1.0 / 3};
  world.surfaces[0].color = Color{1, 2, 255};
  world.surfaces[1].thickness = 0.12;
  world.surfaces[1].source = Source::inferred;
  world.openings.push_back({.id = 7,
                            .kind = OpeningKind::window,
                            .surface = 1,
                            .loop = {8, 9, 10, 11},
                            .width = 1,
                            .height = 1,
                            .evidence = "seen through",
                            .leaf = Leaf{0, 1.0 / 3, LeafHinge::right, LeafSide::front}});
  world.openings[0].loop = world.surfaces[1].holes[0];
  world.obstacles = {
      {.id = 0,
       .shape =
           OrientedBox{
               {1, 1, 0.5}, {1, 1, 1}, Eigen::Quaterniond(std::sqrt(0.5), 0, 0, std::sqrt(0.5))}},
      {.id = 1, .shape = ConvexHull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
      {.id = 2, .shape = Cylinder{{2, 2, 1}, 0.3, 2}}};
  world.colliders = {
      {.surface = 0,
       .shape = OrientedBox{{2, 1.5, -0.05}, {4, 3, 0.1}, Eigen::Quaterniond::Identity()}},
      {.surface = 1, .shape = ConvexPrism{{{0, 0, 0}, {4, 0, 0}, {4, 0, 1}}, {0, -0.1, 0}}}};
  world.curves = {{4,
                   {{CurveType::cylinder, {2, 2, 1}, Vec3::UnitZ(), 0.3},
                    -1,
                    1,
                    Vec3::UnitX(),
                    6,
                    false,
                    {1234, 0.1, 1.0 / 3}}},
                  {5,
                   {{CurveType::sphere, {1, 2, 0.1}, Vec3::UnitY(), 7},
                    0,
                    6.5,
                    Vec3::UnitX(),
                    0.3,
                    true,
                    {55, 0.02, 1}}},
                  {6,
                   {{CurveType::cone, {3, 2, 2}, -Vec3::UnitZ(), 0, 0.25},
                    0.1,
                    1.9,
                    Vec3::UnitX(),
                    3,
                    false,
                    {321, 0.003, 0.9}}}};
  world.obstacles[2].curve = 4, world.surfaces[1].curve = 5;
  world.rooms = {{0, "hall", {0, 1}}, {1, "yard", {}}};
  world.doors = {{7, {0, 1}}};
  world.ways = {{.id = 3,
                 .foot = {1, 1, 0},
                 .top = {2, 1, 1.0 / 3},
                 .width = 0.9,
                 .steps = 2,
                 .riser = 1.0 / 6,
                 .tread = 1,
                 .floors = {0, std::nullopt},
                 .rooms = {0, 1}},
                {.id = 4,
                 .kind = WayKind::ramp,
                 .foot = {1, 2, 0},
                 .top = {2, 2, 0.1},
                 .width = 1,
                 .slope = 0.0996686524911620,
                 .rooms = {1, std::nullopt}}};
  world.provenance = {
      "scanworld 0",
      {{"a.ply", 12, "00ff"}},
      {{"flag", true}, {"count", std::int64_t{-3}}, {"size", 0.1}, {"name", std::string("x")}}};
  return world;
}

World scaled(World world, double factor) {
  for (Vec3& v : world.vertices) v *= factor;
  for (Surface& s : world.surfaces) s.plane.offset *= factor;
  return world;
}

}  // namespace scanworld::test
