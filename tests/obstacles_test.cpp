// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/obstacles.h"

#include "parallel.h"
#include "support/clutter.h"
#include "world/ray_scene.h"
#include "world/validate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// A world with the obstacles that unlabelled points give.
World enclose(const PointCloud& cloud, const ObstacleOptions& options = {}) {
  World world = floor_world();
  const std::vector<std::int32_t> labels(cloud.points.size(), -1);
  world.obstacles = find_obstacles(cloud, labels, world, {kNoise, kThingSpacing}, options).kept;
  CHECK(validate(world).empty());
  return world;
}

World enclose(const std::vector<Vec3>& points, const ObstacleOptions& options = {}) {
  return enclose(cloud_of(points), options);
}

// Points anywhere, as a scan has them, and those that missed the floor's label.
void add_strays(std::vector<Vec3>& points, int count, Random& random) {
  for (int i = 0; i < count; ++i) {
    points.emplace_back(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-1, 3));
    points.emplace_back(random.uniform(-5, 5), random.uniform(-5, 5), kNoise * random.gauss());
  }
}

// Some of each: a drum, a crate and a ball that do not touch.
std::vector<Vec3> some_things(Random& random) {
  std::vector<Vec3> points;
  add_drum(points, {0, 0, 0.5}, 0.3, 1, kThingSpacing, kNoise, random);
  add_crate(points, {2, 1, 0.3}, {0.8, 0.5, 0.6}, 0.4, kThingSpacing, kNoise, random);
  add_ball(points, {-2, 1, 0.4}, 0.3, kThingSpacing, kNoise, random);
  return points;
}

double nearest_outside(const World& world, const Vec3& p) {
  double least = 1e300;
  for (const Obstacle& o : world.obstacles) least = std::min(least, outside_of(o, world.frame, p));
  return least;
}

}  // namespace

TEST_CASE("a drum, a crate and a ball become a cylinder, a box and a hull that hold their points") {
  Random random(1);
  const std::vector<Vec3> points = some_things(random);
  std::vector<Vec3> all = points;
  add_strays(all, 2000, random);
  const World world = enclose(all);
  std::array<int, 3> kinds{};
  for (const Obstacle& o : world.obstacles) ++kinds[o.shape.index()];
  CHECK(kinds == std::array{1, 1, 1});
  for (const Vec3& p : points)
    if (p.z() > 0.05) CHECK(nearest_outside(world, p) < 0.05);
}

TEST_CASE("strays, and what missed the label of a surface, are no obstacles") {
  Random random(2);
  std::vector<Vec3> points;
  add_strays(points, 20000, random);
  CHECK(enclose(points).obstacles.empty());
}

TEST_CASE("a curtain of points between an edge and what is behind is no obstacle") {
  Random random(3);
  std::vector<Vec3> points;
  // From one column of rays, every second of which meets an edge 1 m before a wall.
  for (double z = 0.3; z < 2; z += kThingSpacing)
    if (random.uniform() < 0.5) points.emplace_back(1, random.uniform(0, 1), z);
  CHECK(enclose(points).obstacles.empty());
}

TEST_CASE("two drums half a metre apart stay two, and one can pass between them") {
  Random random(4);
  std::vector<Vec3> points;
  for (double x : {-0.55, 0.55})
    add_drum(points, {x, 0, 0.5}, 0.3, 1, kThingSpacing, kNoise, random);
  const World world = enclose(points);
  REQUIRE(world.obstacles.size() == 2);
  const RayScene scene(world);
  for (double x : {-0.22, 0.0, 0.22})
    for (double z : {0.1, 0.5, 0.9}) CHECK(scene.is_free({x, -1, z}, {x, 1, z}));
}

TEST_CASE("the frame of a door is enclosed piece by piece: one can go through") {
  Random random(5);
  std::vector<Vec3> points;
  for (double x : {-0.5, 0.5})
    add_crate(points, {x, 0, 1.05}, {0.1, 0.15, 2.1}, 0, kThingSpacing, kNoise, random);
  add_crate(points, {0, 0, 2.15}, {1.1, 0.15, 0.1}, 0, kThingSpacing, kNoise, random);
  const World world = enclose(points);
  CHECK(world.obstacles.size() >= 3);
  const RayScene scene(world);
  for (double x = -0.4; x <= 0.4; x += 0.1)
    for (double z = 0.1; z < 2.05; z += 0.1) {
      CAPTURE(x);
      CAPTURE(z);
      CHECK(scene.is_free({x, -1, z}, {x, 1, z}));
    }
}

TEST_CASE("balls that touch are parted") {
  Random random(6);
  std::vector<Vec3> points;
  for (double x : {-0.3, 0.3}) add_ball(points, {x, 0, 0.6}, 0.3, kThingSpacing, kNoise, random);
  const World world = enclose(points);
  CHECK(world.obstacles.size() == 2);
  const RayScene scene(world);
  for (double side : {-0.2, 0.2}) CHECK(scene.is_free({0, -1, 0.6 + side}, {0, 1, 0.6 + side}));
}

TEST_CASE("the same obstacles for any order of the points and any number of threads") {
  Random random(7);
  std::vector<Vec3> points = some_things(random);
  for (double x : {-0.3, 0.3}) add_ball(points, {x, -2, 0.6}, 0.3, kThingSpacing, kNoise, random);
  add_strays(points, 500, random);
  PointCloud cloud = cloud_of(points);
  const std::string expected = world_text(enclose(cloud));
  for (int threads : {1, 2, 3}) {
    const ThreadLimit limit(threads);
    shuffle_points(cloud, static_cast<std::uint64_t>(threads));
    CHECK(world_text(enclose(cloud)) == expected);
  }
}

TEST_CASE("the budget keeps the largest and tells how many are left out") {
  Random random(8);
  const PointCloud cloud = cloud_of(some_things(random));
  const World world = floor_world();
  const std::vector<std::int32_t> labels(cloud.points.size(), -1);
  const auto find = [&](int most) {
    return find_obstacles(cloud, labels, world, {kNoise, kThingSpacing}, {.max_obstacles = most});
  };
  const Obstacles all = find(100), two = find(2);
  CHECK(all.left_out == 0);
  CHECK(two.left_out == 1);
  REQUIRE(two.kept.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) CHECK(two.kept[k] == all.kept[k]);
  CHECK(find(0).kept.empty());
}

TEST_CASE("no points, one point and points a long way off are nothing to enclose") {
  CHECK(enclose(std::vector<Vec3>{}).obstacles.empty());
  CHECK(enclose(std::vector<Vec3>{{1, 1, 1}}).obstacles.empty());
  CHECK(enclose(std::vector<Vec3>(1000, Vec3(1e7, -1e7, 1e7))).obstacles.empty());
  CHECK(enclose(std::vector<Vec3>(1000, Vec3(1, 1, 1))).obstacles.empty());
}

namespace {

// A wall of things, 10 cm thick.
void add_bank(std::vector<Vec3>& points, const Vec3& low, const Vec3& high, Random& random) {
  const Vec3 size = high - low;
  add_crate(points, (low + high) / 2, size, 0, kThingSpacing, kNoise, random);
}

// The floor, wherever it is seen from above.
void add_floor(std::vector<Vec3>& points) {
  for (double x = -4.95; x < 5; x += 0.05)
    for (double y = -4.95; y < 5; y += 0.05) points.emplace_back(x, y, 0);
}

// Whether any obstacle holds a place by more than 5 cm.
bool holds(const World& world, const Vec3& p) { return nearest_outside(world, p) < -0.05; }

}  // namespace

TEST_CASE("no obstacle holds the inside of an L or a U that a viewpoint looks into") {
  for (const bool is_u : {false, true}) {
    CAPTURE(is_u);
    Random random(9);
    std::vector<Vec3> points;
    add_bank(points, {-1, -0.05, 0.02}, {1, 0.05, 1}, random);
    add_bank(points, {-1, 0, 0.02}, {-0.9, 1.5, 1}, random);
    if (is_u) add_bank(points, {0.9, 0, 0.02}, {1, 1.5, 1}, random);
    add_floor(points);
    PointCloud cloud = cloud_of(points);
    cloud.viewpoints = {{0, 3, 1.5}};
    const World world = enclose(cloud);
    CHECK(world.obstacles.size() >= 2);
    for (double x = -0.6; x < 0.7; x += 0.2)
      for (double y = 0.3; y < 1.4; y += 0.2)
        for (double z = 0.25; z < 1; z += 0.2) CHECK_FALSE(holds(world, {x, y, z}));
  }
}

TEST_CASE("a shell that was seen from inside is no drum") {
  Random random(10);
  std::vector<Vec3> points;
  for (int i = 0; i < 40000; ++i) {
    const double angle = random.uniform(-2, 2);
    points.emplace_back(2 * std::cos(angle), 2 * std::sin(angle), random.uniform(0.02, 2));
  }
  add_floor(points);
  PointCloud cloud = cloud_of(points);
  cloud.viewpoints = {{0, 0, 1.5}};
  const World world = enclose(cloud);
  CHECK(!world.obstacles.empty());
  for (double x = -0.5; x < 1.5; x += 0.25)
    for (double z = 0.25; z < 1.9; z += 0.25) CHECK_FALSE(holds(world, {x, 0, z}));
}

TEST_CASE("a crate stays one box, from wherever it is seen") {
  Random random(11);
  std::vector<Vec3> points;
  add_crate(points, {0, 0, 0.5}, {1, 0.8, 1}, 0.3, kThingSpacing, kNoise, random);
  add_floor(points);
  PointCloud cloud = cloud_of(points);
  cloud.viewpoints = {{3, 3, 1.5}, {-3, 2, 1.5}, {0, -3, 1.5}};
  const World world = enclose(cloud);
  REQUIRE(world.obstacles.size() == 1);
  CHECK(std::holds_alternative<OrientedBox>(world.obstacles[0].shape));
}
