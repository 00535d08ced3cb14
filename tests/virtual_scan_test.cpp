// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/virtual_scan.h"

#include <map>

#include "parallel.h"
#include "support/scenes.h"
#include "world/ray_scene.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

World office() { return read_world(in_project("worlds/office.json")); }
World room() { return read_world(in_project("worlds/room.json")); }

}  // namespace

TEST_CASE("without noise every point lies on the surface that it names") {
  const World world = office();
  const VirtualScan scan = virtual_scan(world, {.points = 20000, .noise = 0});
  CHECK(scan.cloud.points.size() == 20000);
  for (std::size_t i = 0; i < scan.cloud.points.size(); ++i) {
    if (scan.surface[i] < 0) {
      CHECK(scan.kind[i] == static_cast<int>(PointKind::obstacle));
      continue;
    }
    CHECK(std::abs(world.surfaces[static_cast<std::size_t>(scan.surface[i])].plane.signed_distance(
              scan.cloud.points[i].cast<double>())) < 1e-4);
  }
}

TEST_CASE("the noise of the points is the noise asked for") {
  const World world = room();
  const VirtualScan scan = virtual_scan(world, {.points = 50000, .noise = 0.02});
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < scan.cloud.points.size(); ++i) {
    if (scan.kind[i] != static_cast<int>(PointKind::surface)) continue;
    const Plane& plane = world.surfaces[static_cast<std::size_t>(scan.surface[i])].plane;
    const Vec3 p = scan.cloud.points[i].cast<double>(),
               ray =
                   (p - scan.cloud.viewpoints[static_cast<std::size_t>(scan.pose[i])]).normalized();
    const double along =
        plane.signed_distance(p) / plane.normal.dot(ray);  // noise is along the ray
    if (std::abs(plane.normal.dot(ray)) < 0.3) continue;
    sum += along * along, ++count;
  }
  CHECK(std::sqrt(sum / count) == doctest::Approx(0.02).scale(0).epsilon(0.03));
}

TEST_CASE("outliers and mixed points are there in the share asked for, and labelled") {
  const VirtualScan scan = virtual_scan(office(), {.points = 40000, .outliers = 0.05, .mixed = 1});
  std::map<int, std::size_t> kinds;
  for (int k : scan.kind) ++kinds[k];
  CHECK(scan.cloud.points.size() == doctest::Approx(40000).scale(0).epsilon(0.001));
  CHECK(static_cast<double>(kinds[3]) == doctest::Approx(2000).scale(0).epsilon(0.01));
  CHECK(kinds[2] > 50);
  CHECK(kinds[2] < 4000);
  CHECK(kinds[1] > 100);  // obstacles are met too
}

TEST_CASE("the same seed gives the same scan for any number of threads; another seed another") {
  const auto scan = [](std::uint64_t seed, int threads) {
    const ThreadLimit limit(threads);
    return virtual_scan(room(), {.points = 5000, .outliers = 0.01, .seed = seed}).cloud.points;
  };
  const auto first = scan(1, 1);
  CHECK(scan(1, 2) == first);
  CHECK(scan(1, 4) == first);
  CHECK(scan(2, 1) != first);
}

TEST_CASE("rays pass open doors and windows and meet walls from both sides") {
  const World world = room();
  const RayScene scene(world);
  CHECK_FALSE(scene.cast({2.3, 2, 1.5}, {0, -1, 0}));  // out of the window
  CHECK_FALSE(scene.cast({2.5, 3, 1.5}, {1, 0, 0}));   // out of the door
  CHECK(scene.cast({2.3, 2, 0.5}, {0, -1, 0})->distance == doctest::Approx(2));
  CHECK(scene.cast({2, 6, 1.5}, {0, -1, 0})->distance == doctest::Approx(2));  // from outside
  const auto column = scene.cast({4.4, 2, 0.5}, {0, -1, 0});
  REQUIRE(column);
  CHECK_FALSE(column->is_surface);
  CHECK(column->distance == doctest::Approx(2 - 0.6 - 0.18).scale(0).epsilon(0.01));
  CHECK(scene.is_free({1, 1, 1.5}, {4, 3, 1.5}));
  CHECK_FALSE(scene.is_free({1, 1, 1.5}, {1, 5, 1.5}));
}

TEST_CASE("scanners are placed so that they see every room, on the floor, away from walls") {
  const World world = office();
  const RayScene scene(world);
  const std::vector<Vec3> places = place_scanners(world);
  CHECK(places.size() >= 3);
  CHECK(places.size() <= 12);
  for (const Vec3& p : places) CHECK(p.z() == doctest::Approx(1.5));
  for (const Vec3& corner : {Vec3(1, 1, 1.5), Vec3(1, 6, 1.5), Vec3(9, 5.8, 1.5), Vec3(1, -4, 1.5),
                             Vec3(5, -3.5, 1.5), Vec3(8.5, -1.5, 1.5)})
    CHECK(std::any_of(places.begin(), places.end(),
                      [&](const Vec3& p) { return scene.is_free(p, corner); }));
}

TEST_CASE("options out of range and worlds without anything to see are refused") {
  const auto error = [](const VirtualScanOptions& options) {
    return error_of(Cause::usage, [&] { virtual_scan(room(), options); });
  };
  CHECK(contains(error({.noise = -1}), "noise"));
  CHECK(contains(error({.outliers = 1}), "outliers"));
  CHECK(contains(error({.resolution = 0}), "resolution"));
  error_of(Cause::nothing_found, [] { virtual_scan({}, {}); });
  error_of(Cause::nothing_found, [] { virtual_scan({}, {.poses = {{0, 0, 1}}}); });
}
