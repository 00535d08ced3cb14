// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "thesis/snapping.h"

#include "support/scenes.h"
#include "thesis/filter.h"
#include "thesis/hull.h"
#include "thesis/placing.h"
#include "thesis/spreading.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::thesis;

namespace {

struct SnappedPlace {
  FilteredPoints filtered;
  KdTree tree;
  std::vector<thesis::Cluster> walls;
  std::vector<thesis::Polygon> borders;

  explicit SnappedPlace(const PointCloud& cloud)
      : filtered(filter_points(cloud)), tree(filtered.points) {
    walls = spread_clusters(tree, filtered.delta, place_clusters(tree, filtered.delta));
    borders = find_borders(fit_to_planes(filtered.points, walls), walls);
  }
};

bool is_corner(const Vec3& v, const Vec3& size) {
  for (int k = 0; k < 3; ++k)
    if (std::min(std::abs(v[k]), std::abs(v[k] - size[k])) > 0.005) return false;
  return true;
}

}  // namespace

TEST_CASE(
    "a noisy room snaps and reduces to six rectangles that share eight corners, bit for bit") {
  const Vec3 size(5, 4, 2.7);
  const SnappedPlace room(room_points(size, 0.03, 0.005));
  REQUIRE(room.walls.size() == 6);
  const auto polygons = reduce_vertices(
      snap_vertices(room.borders, room.walls, room.tree, room.filtered.delta), room.filtered.delta);
  std::vector<Vec3> corners;
  for (const thesis::Polygon& p : polygons) {
    CHECK(p.size() == 4);
    for (const Vec3& v : p) {
      CHECK(is_corner(v, size));
      if (std::find(corners.begin(), corners.end(), v) == corners.end()) corners.push_back(v);
    }
  }
  CHECK(corners.size() == 8);
}

TEST_CASE(
    "snapped polygons stay in their plane, are convex, and no vertex moves farther than allowed") {
  PointCloud cloud = room_points({5, 4, 2.7}, 0.03, 0.01);
  Random random(5);
  add_rectangle(cloud, {1, 1, 0.75}, {1.4, 0.2, 0}, {-0.1, 0.8, 0}, 0.02, 0.005, random);
  const SnappedPlace room(cloud);
  const SnappingOptions options;
  const auto snapped =
      snap_vertices(room.borders, room.walls, room.tree, room.filtered.delta, options);
  for (std::size_t i = 0; i < snapped.size(); ++i) {
    const Vec3 normal = room.walls[i].fit.plane.normal;
    for (std::size_t k = 0; k < snapped[i].size(); ++k) {
      const Vec3 &a = snapped[i][k], &b = snapped[i][(k + 1) % snapped[i].size()],
                 &c = snapped[i][(k + 2) % snapped[i].size()];
      CHECK(std::abs(room.walls[i].fit.plane.signed_distance(a)) < 1e-9);
      CHECK((b - a).cross(c - b).dot(normal) > 0);
      double moved = 1e9;
      for (const Vec3& before : room.borders[i]) moved = std::min(moved, (before - a).norm());
      CHECK(moved <= options.max_distance * room.filtered.delta);
    }
  }
}

TEST_CASE("a table's corners are not drawn to the walls, where it has no points") {
  PointCloud cloud = room_points({5, 4, 2.7}, 0.03, 0.003);
  Random random(6);
  const Vec3 corner(1.5, 1.5, 0.75);
  add_rectangle(cloud, corner, {1.4, 0, 0}, {0, 0.8, 0}, 0.02, 0.003, random);
  const SnappedPlace room(cloud);
  REQUIRE(room.walls.size() == 7);
  const auto snapped = snap_vertices(room.borders, room.walls, room.tree, room.filtered.delta);
  for (const Vec3& v : snapped[6]) {
    CHECK(v.x() > 1.4);
    CHECK(v.x() < 3.0);
    CHECK(v.z() == doctest::Approx(0.75).scale(0).epsilon(0.02));
  }
}

TEST_CASE("planes that are nearly parallel have no corner that anything snaps to") {
  PointCloud cloud;
  Random random(7);
  add_rectangle(cloud, {0, 0, 0}, {3, 0, 0}, {0, 3, 0}, 0.02, 0.002, random);
  add_rectangle(cloud, {3, 0, 0}, {3, 0, 0.45}, {0, 3, 0}, 0.02, 0.002, random);  // 9 degrees
  const SnappedPlace room(cloud);
  REQUIRE(room.walls.size() == 2);
  const auto sorted = [](std::vector<thesis::Polygon> polygons) {
    for (thesis::Polygon& p : polygons)
      std::sort(p.begin(), p.end(), [](const Vec3& a, const Vec3& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
      });
    return polygons;
  };
  CHECK(sorted(snap_vertices(room.borders, room.walls, room.tree, room.filtered.delta)) ==
        sorted(room.borders));
  const auto wide =
      snap_vertices(room.borders, room.walls, room.tree, room.filtered.delta, {.min_angle = 0.1});
  CHECK(sorted(wide) != sorted(room.borders));
}

TEST_CASE("reduction drops vertices on a line and keeps three at least") {
  const thesis::Polygon square = {{0, 0, 0},   {1, 0.001, 0}, {2, 0, 0}, {2, 2, 0},
                                  {1, 2.3, 0}, {0, 2, 0},     {0, 1, 0}};
  CHECK(reduce_vertices({square}, 0.1, {.max_distance = 0.5})[0] ==
        thesis::Polygon{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2.3, 0}, {0, 2, 0}});
  CHECK(reduce_vertices({square}, 0.1, {.max_distance = 5})[0].size() == 4);
  CHECK(reduce_vertices({square}, 0.1, {.max_distance = 1e6})[0].size() == 3);
  CHECK(reduce_vertices({{}}, 0.1)[0].empty());
}
