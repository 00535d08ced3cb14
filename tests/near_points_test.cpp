// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/near_points.h"

#include <algorithm>

#include "support/scenes.h"

using namespace scanworld;
using namespace scanworld::test;

TEST_CASE("the nearest point is the one that trying all finds, at any reach") {
  Random random(3);
  std::vector<Vec3> points, places;
  for (int i = 0; i < 3000; ++i)
    points.emplace_back(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(0, 0.3));
  for (int i = 0; i < 400; ++i)
    places.emplace_back(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-1, 1));
  places.push_back(points[0]);
  PointCloud cloud = cloud_of(points);
  cloud.origin = {10, 20, 30};
  const CloudInWorld in_world(cloud, {.origin = {10, 20, 30}});
  for (double reach : {0.02, 0.1, 0.7, 5.0}) {
    const double max_distance = 0.8;
    const auto found = nearest_point_distances(places, in_world, reach, max_distance);
    REQUIRE(found.size() == places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      double nearest = max_distance;
      for (const Vec3f& p : cloud.points)
        nearest = std::min(nearest, (p.cast<double>() - places[i]).norm());
      CHECK(found[i] == doctest::Approx(nearest).scale(0).epsilon(1e-5));
    }
    CHECK(found.back() == doctest::Approx(0));
  }
}

TEST_CASE("places far from all points and places far from the origin have an answer") {
  const PointCloud cloud = cloud_of({{0, 0, 0}, {7000, 7000, 0}});
  const auto found = nearest_point_distances({{0.1, 0, 0}, {7000, 7000.25, 0}, {1e7, 1e8, 1e9}},
                                             CloudInWorld(cloud, {}), 0.05, 0.5);
  CHECK(found[0] == doctest::Approx(0.1));
  CHECK(found[1] == doctest::Approx(0.25));
  CHECK(found[2] == 0.5);
  CHECK(nearest_point_distances({}, CloudInWorld(cloud, {}), 0.05, 0.5).empty());
}

TEST_CASE("planes are seen where the scan is planar, and not on clutter, edges and lines") {
  PointCloud cloud;
  Random random(5);
  add_rectangle(cloud, {0, 0, 0.1}, {2, 0, 0}, {0, 2, 0}, 0.02, 0.004, random);  // level
  for (int i = 0; i < 2000; ++i)  // a ball, round enough
    cloud.points.push_back((Vec3(5, 5, 1) + 0.2 * random.direction()).cast<float>());
  for (int i = 0; i < 500; ++i)  // a line
    cloud.points.push_back(Vec3f(8, 0.002f * static_cast<float>(i), 0.1f));
  const auto normals =
      planar_normals({{1, 1, 0.1}, {1, 1, 0.13}, {5, 5, 1.2}, {8, 0.2, 0.1}, {20, 20, 20}},
                     CloudInWorld(cloud, {}), {.cell = 0.4, .noise = 0.004});
  REQUIRE(normals.size() == 5);
  REQUIRE(normals[0]);
  CHECK(std::abs(normals[0]->z()) > 0.999);
  CHECK_FALSE(normals[1]);  // over the plane
  CHECK_FALSE(normals[2]);
  CHECK_FALSE(normals[3]);
  CHECK_FALSE(normals[4]);
}
