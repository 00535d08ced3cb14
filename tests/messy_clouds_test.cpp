// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// `reconstruct` on clouds that no real place is like.
#include <algorithm>
#include <iterator>
#include <set>

#include "reconstruct.h"
#include "support/clutter.h"
#include "support/scenes.h"
#include "world/triangulate.h"
#include "world/validate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr int kClouds = 40;
#else
constexpr int kClouds = 400;
#endif

Vec3 place_in(Random& random, double size) {
  return {random.uniform(0, size), random.uniform(0, size), random.uniform(0, size)};
}

Vec3 across(const Vec3& direction, Random& random) {
  return direction.cross(random.direction()).normalized();
}

// A rectangle of any slope; one side may be as narrow as noise.
void add_plane(PointCloud& cloud, Random& random) {
  const Vec3 a = random.direction(), b = across(a, random);
  const double narrow = random.whole(0, 2) ? random.uniform(0.3, 2) : random.uniform(0.02, 0.15);
  add_rectangle(cloud, place_in(random, 2), random.uniform(0.3, 3) * a, narrow * b,
                random.uniform(0.03, 0.07), random.uniform(0, 0.02), random);
}

// A room with a wall in it that is thin, or not quite upright.
void add_room(PointCloud& cloud, Random& random) {
  const Vec3 size(random.uniform(1, 3), random.uniform(1, 3), random.uniform(0.5, 2.5));
  const PointCloud room = room_points(size, 0.06, random.uniform(0, 0.015), random.next());
  cloud.points.insert(cloud.points.end(), room.points.begin(), room.points.end());
  const double thickness = random.uniform(0.02, 0.2), lean = random.uniform(-0.1, 0.1);
  for (const double x : {0.5 * size.x(), 0.5 * size.x() + thickness})
    add_rectangle(cloud, {x, 0, 0}, {0, 0.7 * size.y(), 0}, {lean, 0, size.z()}, 0.05, 0.005,
                  random);
}

// Cuts out boxes, so that planes get windows and end in steps.
void cut_windows(PointCloud& cloud, Random& random) {
  for (int k = random.whole(1, 5); k > 0; --k) {
    const Vec3 low = place_in(random, 2.5);
    const Box3 box(low, low + place_in(random, 1));
    std::erase_if(cloud.points, [&](const Vec3f& p) { return box.contains(p.cast<double>()); });
  }
}

void add_noise_cube(PointCloud& cloud, Random& random) {
  const Vec3 corner = place_in(random, 2);
  const double size = random.uniform(0.1, 1.5);
  for (int k = random.whole(50, 1500); k > 0; --k)
    cloud.points.push_back((corner + place_in(random, size)).cast<float>());
}

// Rings as spinning lidars leave them on a floor and around.
void add_rings(PointCloud& cloud, Random& random) {
  const Vec3 middle = place_in(random, 2), axis = random.direction(), side = across(axis, random);
  const bool is_tube = random.whole(0, 1);
  for (int ring = 1; ring < 8; ++ring)
    for (int k = 0; k < 150; ++k) {
      const Vec3 way = Eigen::AngleAxisd(2 * M_PI * k / 150, axis) * side;
      const Vec3 at = is_tube ? Vec3(way + 0.15 * ring * axis) : Vec3(0.2 * ring * way);
      cloud.points.push_back((middle + at).cast<float>());
    }
}

void add_sphere(PointCloud& cloud, Random& random) {
  std::vector<Vec3> points;
  add_ball(points, place_in(random, 2), random.uniform(0.1, 0.8), 0.05, 0.003, random);
  for (const Vec3& p : points) cloud.points.push_back(p.cast<float>());
}

// Points of a grid without noise, in a plane, in a block or in a staircase.
void add_grid(PointCloud& cloud, Random& random) {
  const int depth = random.whole(1, 4), step = random.whole(0, 1);
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 20; ++y)
      for (int z = 0; z < depth; ++z)
        cloud.points.emplace_back(0.0625F * float(x), 0.0625F * float(y),
                                  0.0625F * float(z + step * (x / 5)));
}

void add_line(PointCloud& cloud, Random& random) {
  const Vec3 from = place_in(random, 2), way = random.direction();
  for (int k = 0; k < 300; ++k)
    cloud.points.push_back((from + random.uniform(0, 3) * way).cast<float>());
}

void add_outliers(PointCloud& cloud, Random& random) {
  const double reach = random.whole(0, 3) ? 5 : 500;
  for (int k = random.whole(1, 60); k > 0; --k)
    cloud.points.push_back((place_in(random, reach) - Vec3::Constant(reach / 2)).cast<float>());
}

void double_points(PointCloud& cloud, Random& random) {
  const std::size_t count = cloud.points.size();
  cloud.points.reserve(2 * count);
  for (std::size_t i = 0; i < count; ++i)
    if (random.whole(0, 1)) cloud.points.push_back(cloud.points[i]);
}

void move_far(PointCloud& cloud, Random& random) {
  if (random.whole(0, 1))
    cloud.origin = {5e5, 5.4e6, 300};
  else
    for (Vec3f& p : cloud.points) p += Vec3f(3000, -2000, 500);
}

void add_normals(PointCloud& cloud, Random& random) {
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    cloud.normals.push_back(random.whole(0, 3) ? random.direction().cast<float>()
                                               : Vec3f(Vec3f::Zero()));
}

// A few things over each other, and what may be amiss with all of them.
PointCloud messy_cloud(std::uint64_t seed) {
  constexpr void (*kThings[])(PointCloud&, Random&) = {
      add_plane, add_plane, add_plane,  add_room, add_noise_cube,
      add_rings, add_grid,  add_sphere, add_line, add_outliers};
  Random random(seed);
  PointCloud cloud;
  for (int k = random.whole(1, 6); k > 0; --k)
    kThings[random.next() % std::size(kThings)](cloud, random);
  if (random.whole(0, 2) == 0) cut_windows(cloud, random);
  if (random.whole(0, 3) == 0) double_points(cloud, random);
  if (random.whole(0, 9) == 0) cloud.points.resize(std::min<std::size_t>(2, cloud.points.size()));
  if (cloud.points.empty()) cloud.points.push_back(Vec3f(1, 2, 3));
  if (random.whole(0, 5) == 0) move_far(cloud, random);
  if (random.whole(0, 2) == 0) add_normals(cloud, random);
  for (int k = random.whole(0, 2); k > 0; --k) cloud.viewpoints.push_back(place_in(random, 2.5));
  return cloud;
}

// What must hold of any world; true where there is one.
bool check_world(const PointCloud& cloud, const ReconstructOptions& options) {
  ReconstructResult result;
  try {
    result = reconstruct(cloud, options);
  } catch (const Error& error) {
    CHECK_MESSAGE(error.cause == Cause::nothing_found, error.what());
    return false;
  }
  const auto reasons = validate(result.world);
  CHECK_MESSAGE(reasons.empty(), (reasons.empty() ? "" : reasons[0]));
  CHECK_NOTHROW(triangulate(result.world));
  CHECK_FALSE(result.world.surfaces.empty());
  CHECK(result.labels.size() == cloud.points.size());
  std::set<std::int32_t> ids = {-1};
  for (const Surface& s : result.world.surfaces) ids.insert(s.id);
  CHECK(std::all_of(result.labels.begin(), result.labels.end(),
                    [&](std::int32_t label) { return ids.contains(label); }));
  if (options.method == Method::rival)
    CHECK(result.report.plane_noise.size() == result.world.surfaces.size());
  return true;
}

}  // namespace

TEST_CASE("of any messy cloud a valid world is made, or nothing is found") {
  for (const Method method : {Method::rival, Method::thesis}) {
    int worlds = 0;
    for (int seed = 1; seed <= kClouds / 2; ++seed) {
      CAPTURE(name_of(method));
      CAPTURE(seed);
      ReconstructOptions options{.method = method};
      options.frame.level = seed % 4 == 0, options.frame.floor_at_zero = seed % 6 == 0;
      worlds += check_world(messy_cloud(static_cast<std::uint64_t>(seed)), options);
    }
    CHECK(worlds > kClouds / 4);  // else these clouds test little
  }
}

TEST_CASE("a messy cloud gives the same world in any order of its points") {
  for (std::uint64_t seed = 1; seed <= kClouds / 20; ++seed) {
    CAPTURE(seed);
    PointCloud cloud = messy_cloud(seed);
    cloud.normals.clear();
    if (!check_world(cloud, {})) continue;
    const std::string text = world_text(reconstruct(cloud).world);
    shuffle_points(cloud, seed);
    CHECK(world_text(reconstruct(cloud).world) == text);
  }
}
