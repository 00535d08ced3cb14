// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/level.h"

#include "reconstruct.h"
#include "support/scenes.h"
#include "world/solids.h"
#include "world/validate.h"
#include "world/virtual_scan.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

Eigen::Quaterniond random_rotation(Random& random) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(random.uniform(0, M_PI), random.direction()));
}

// All points of a world in the coordinates of its scan.
std::vector<Vec3> points_in_scan(const World& world) {
  std::vector<Vec3> points = world.vertices;
  for (const Obstacle& o : world.obstacles) {
    const Mesh mesh = mesh_of(o, world.frame);
    points.insert(points.end(), mesh.vertices.begin(), mesh.vertices.end());
  }
  for (const Collider& c : world.colliders) {
    const Mesh mesh = std::visit([](const auto& shape) { return mesh_of(shape); }, c.shape);
    points.insert(points.end(), mesh.vertices.begin(), mesh.vertices.end());
  }
  for (Vec3& p : points) p = world.frame.to_scan(p);
  return points;
}

// Whether each point of one list is near one of the other.
bool are_same(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  if (a.size() != b.size()) return false;
  return std::all_of(a.begin(), a.end(),
                     [&](const Vec3& p) { return (nearest_of(b, p) - p).norm() < 3e-6; });
}

World near_origin() {
  World world = full_world();
  world.frame.origin = {12.5, -3, 1};
  world.obstacles.pop_back();  // the facets of a cylinder start anywhere
  return world;
}

}  // namespace

TEST_CASE("a frame's coordinates go to the scan's and back") {
  Random random(1);
  for (int round = 0; round < 100; ++round) {
    const Frame frame{.origin = 1e4 * random.direction(), .rotation = random_rotation(random)};
    const Vec3 p = 30 * random.direction();
    CHECK((frame.to_world(frame.to_scan(p)) - p).norm() < 1e-10);
  }
  CHECK(Frame{.origin = {1, 2, 3}}.to_scan({1, 1, 1}) == Vec3(2, 3, 4));
}

TEST_CASE("a world that is moved is the same place in the scan's coordinates") {
  Random random(2);
  const World world = near_origin();
  for (int round = 0; round < 50; ++round) {
    const World other = moved(world, random_rotation(random), 5 * random.direction());
    CHECK(validate(other).empty());
    CHECK(are_same(points_in_scan(world), points_in_scan(other)));
    CHECK((other.frame.rotation * other.frame.up - Vec3::UnitZ()).norm() < 1e-12);
    for (std::size_t i = 0; i < world.surfaces.size(); ++i)
      CHECK(area(other, other.surfaces[i]) ==
            doctest::Approx(area(world, world.surfaces[i])).epsilon(1e-5));
  }
}

TEST_CASE("a cylinder stays upright and where it is") {
  Random random(3);
  World world = full_world();
  world.frame.origin.setZero();
  const World other = moved(world, random_rotation(random), {1, 2, 3});
  const auto &before = std::get<Cylinder>(world.obstacles[2].shape),
             &after = std::get<Cylinder>(other.obstacles[2].shape);
  CHECK((other.frame.to_scan(after.center) - before.center).norm() < 1e-12);
  CHECK((other.frame.rotation * other.frame.up - world.frame.up).norm() < 1e-12);
}

TEST_CASE("a levelled world is upright by the smallest turn, and says so") {
  Random random(4);
  for (int round = 0; round < 50; ++round) {
    const World tilted = moved(near_origin(), random_rotation(random), 3 * random.direction());
    const World level = level_world(tilted, {.level = true});
    CHECK(level.frame.up == Vec3::UnitZ());
    CHECK(validate(level).empty());
    CHECK(are_same(points_in_scan(tilted), points_in_scan(level)));
    const Eigen::Quaterniond turned = level.frame.rotation.conjugate() * tilted.frame.rotation;
    CHECK(Eigen::AngleAxisd(turned).angle() ==
          doctest::Approx(tilt_of(tilted.frame)).epsilon(1e-6));
    CHECK(std::abs(Eigen::AngleAxisd(turned).axis().z()) < 1e-6);  // no turn of the heading
    CHECK((level.surfaces[0].plane.normal - Vec3::UnitZ()).norm() < 1e-9);
    CHECK(contains(level.frame.assumed.back(), "turned upright on request"));
  }
}

TEST_CASE("the largest floor is put at height 0, tilted or not") {
  Random random(5);
  const World tilted = moved(near_origin(), random_rotation(random), {3, 4, 5});
  for (bool level : {false, true}) {
    const World world = level_world(tilted, {.level = level, .floor_at_zero = true});
    REQUIRE(main_floor(world));
    CHECK(std::abs(world.frame.up.dot(centroid(world, *main_floor(world)))) < 3e-6);
    CHECK(are_same(points_in_scan(tilted), points_in_scan(world)));
    CHECK(contains(world.frame.assumed.back(), "largest floor (surface 0) is at 0"));
    if (!level) CHECK(world.frame.rotation.coeffs() == tilted.frame.rotation.coeffs());
    if (level)
      for (int v : main_floor(world)->outer)
        CHECK(std::abs(world.vertices[static_cast<std::size_t>(v)].z()) < 3e-6);
  }
}

TEST_CASE("nothing moves that was not asked to, or need not") {
  Random random(6);
  const World world = near_origin(), tilted = moved(world, random_rotation(random), Vec3::Zero());
  CHECK(level_world(tilted, {}) == tilted);
  CHECK(level_world(world, {.level = true}) == world);
  World no_floor = world;
  for (Surface& s : no_floor.surfaces) s.kind = Kind::other;
  const World same = level_world(no_floor, {.floor_at_zero = true});
  CHECK(same.vertices == no_floor.vertices);
  CHECK(contains(same.frame.assumed.back(), "there is none"));
}

TEST_CASE("the main floor is the largest one") {
  World world = small_world();
  CHECK(main_floor(world)->id == 0);
  CHECK((centroid(world, world.surfaces[0]) - Vec3(2, 1.5, 0)).norm() < 1e-9);
  // The wall of 4 by 2.5 m has a window from 1 to 2 m.
  CHECK(
      (centroid(world, world.surfaces[1]) - Vec3((10 * 2 - 1.5) / 9, 0, (12.5 - 1.5) / 9)).norm() <
      1e-9);
  world.surfaces[1].kind = Kind::floor;
  CHECK(main_floor(world)->id == 0);
  world.surfaces[0].kind = Kind::wall;
  CHECK(main_floor(world)->id == 1);
}

TEST_CASE("a turned frame is written and read to the bit, and one without rotation is not turned") {
  Random random(7);
  const World turned = moved(full_world(), random_rotation(random), {1, 2, 3});
  CHECK(parse_world(world_text(turned)) == turned);
  CHECK(contains(world_text(turned), "\"rotation\""));
  World bare = full_world();
  bare.obstacles.clear(), bare.colliders.clear();
  CHECK_FALSE(contains(world_text(bare), "\"rotation\""));
  CHECK(parse_world(world_text(bare)).frame.rotation.coeffs() ==
        Eigen::Quaterniond::Identity().coeffs());
  World stretched = turned;
  stretched.frame.rotation.w() += 0.1;
  CHECK(contains(validate(stretched)[0], "rotation is not of length 1"));
}

TEST_CASE("the scan of a levelled world lies where the world was scanned") {
  const World room = read_world(in_project("worlds/room.json"));
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(0.3, Vec3(1, 1, 0).normalized()));
  // The room as found in a tilted scan, and then levelled.
  World tilted = room;
  tilted = moved(std::move(tilted), tilt, {1, 2, 3});
  tilted.frame.rotation.setIdentity(), tilted.frame.origin.setZero();
  const World level = level_world(tilted, {.level = true, .floor_at_zero = true});
  const VirtualScan scan = virtual_scan(level, {.points = 3000, .noise = 0});
  REQUIRE(scan.cloud.points.size() > 2000);
  for (std::size_t i = 0; i < scan.cloud.points.size(); ++i) {
    if (scan.surface[i] < 0) continue;
    const Vec3 p = scan.cloud.points[i].cast<double>() + scan.cloud.origin;
    const auto s = static_cast<std::size_t>(scan.surface[i]);
    CHECK(std::abs(tilted.surfaces[s].plane.signed_distance(p)) < 1e-4);
  }
}

TEST_CASE("a tilted scan, levelled, is the world of the upright one, by both methods") {
  const PointCloud upright = room_points({5, 4, 2.7}, 0.05, 0.01);
  Random random(8);
  for (Method method : {Method::rival, Method::thesis}) {
    const Eigen::Quaterniond tilt(Eigen::AngleAxisd(
        random.uniform(1, 9) * kDegree, Vec3(random.uniform(-1, 1), 1, 0).normalized()));
    PointCloud cloud = upright;
    for (Vec3f& p : cloud.points) p = (tilt * p.cast<double>()).cast<float>();
    ReconstructOptions options{.method = method};
    const World as_is = reconstruct(cloud, options).world;
    CHECK(as_is.frame.rotation.coeffs() == Eigen::Quaterniond::Identity().coeffs());
    CHECK((as_is.frame.up - tilt * Vec3::UnitZ()).norm() < 0.05 * kDegree);
    options.frame = {.level = true, .floor_at_zero = true};
    const World world = reconstruct(cloud, options).world;
    CHECK(std::get<bool>(world.provenance.options.at("frame.level")));
    CHECK(validate(world).empty());
    REQUIRE(world.surfaces.size() == 6);
    // The smallest turn takes headings that were tilted back to where they were, but for the
    // second order.
    const Eigen::Quaterniond back = world.frame.rotation.conjugate() * tilt;
    for (const Surface& s : world.surfaces) {
      double nearest = 1;
      for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())})
        for (double sign : {1.0, -1.0})
          nearest = std::min(nearest, (s.plane.normal - sign * (back * axis)).norm());
      CHECK(nearest < 0.1 * kDegree);
    }
    CHECK(std::abs(back.z()) < 0.001);  // the heading
    for (int v : main_floor(world)->outer)
      CHECK(std::abs(world.vertices[static_cast<std::size_t>(v)].z()) < 0.003);
  }
}
