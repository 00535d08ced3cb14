// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "thesis/walls.h"

#include "support/scenes.h"
#include "thesis/filter.h"
#include "thesis/labels.h"
#include "thesis/placing.h"
#include "thesis/spreading.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::thesis;

namespace {

std::vector<FoundSurface> walls_of(const PointCloud& cloud, std::vector<std::int32_t>& labels) {
  const FilteredPoints filtered = filter_points(cloud);
  const KdTree tree(filtered.points);
  const auto walls = spread_clusters(tree, filtered.delta, place_clusters(tree, filtered.delta));
  labels = label_points(cloud, filtered, walls, tree, 0.4 * filtered.delta);
  return describe_walls(cloud, labels, filtered.points, filtered.delta, walls,
                        find_borders(fit_to_planes(filtered.points, walls), walls));
}

}  // namespace

TEST_CASE("a room's walls face its inside, with and without a known viewpoint") {
  PointCloud cloud = room_points({5, 4, 2.7}, 0.03, 0.005);
  std::vector<std::int32_t> labels;
  for (const std::vector<Vec3>& viewpoints : {std::vector<Vec3>{}, {{1, 1, 1.5}}}) {
    cloud.viewpoints = viewpoints;
    for (const FoundSurface& wall : walls_of(cloud, labels)) {
      CHECK(wall.plane.signed_distance({2.5, 2, 1.3}) > 0);
      CHECK((wall.outer[1] - wall.outer[0])
                .cross(wall.outer[2] - wall.outer[1])
                .dot(wall.plane.normal) > 0);
    }
  }
  cloud.viewpoints = {{20, 20, 20}};  // seen from outside
  for (const FoundSurface& wall : walls_of(cloud, labels))
    CHECK(wall.plane.signed_distance({20, 20, 20}) > 0);
}

TEST_CASE("points, noise and coverage of a wall are those of the scan") {
  PointCloud cloud;
  Random random(1);
  add_rectangle(cloud, {0, 0, 0}, {4, 0, 0}, {0, 3, 0}, 0.02, 0.006, random);
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    cloud.colors.push_back({100, static_cast<std::uint8_t>(i % 2 ? 40 : 60), 7});
  std::vector<std::int32_t> labels;
  const auto walls = walls_of(cloud, labels);
  REQUIRE(walls.size() == 1);
  CHECK(static_cast<double>(walls[0].support.points) >
        0.99 * static_cast<double>(cloud.points.size()));
  CHECK(walls[0].support.rms == doctest::Approx(0.006).scale(0).epsilon(0.05));
  CHECK(walls[0].support.coverage > 0.95);
  CHECK(walls[0].color->r == 100);
  CHECK(std::abs(walls[0].color->g - 50) <= 1);
  CHECK(walls[0].color->b == 7);
}

TEST_CASE("a wall with a large hole is covered in part") {
  PointCloud cloud;
  Random random(2);
  add_rectangle(cloud, {0, 0, 0}, {4, 0, 0}, {0, 1, 0}, 0.02, 0.002, random);
  add_rectangle(cloud, {0, 1, 0}, {1, 0, 0}, {0, 2, 0}, 0.02, 0.002, random);
  add_rectangle(cloud, {3, 1, 0}, {1, 0, 0}, {0, 2, 0}, 0.02, 0.002, random);
  std::vector<std::int32_t> labels;
  const auto walls = walls_of(cloud, labels);
  REQUIRE(walls.size() == 1);
  CHECK(walls[0].support.coverage == doctest::Approx(8.0 / 12).scale(0).epsilon(0.1));
}

TEST_CASE(
    "each labelled point lies within the distance of its wall, and nearly all points of a room are "
    "labelled") {
  const PointCloud cloud = room_points({5, 4, 2.7}, 0.03, 0.005);
  const FilteredPoints filtered = filter_points(cloud);
  const KdTree tree(filtered.points);
  const auto walls = spread_clusters(tree, filtered.delta, place_clusters(tree, filtered.delta));
  const double max_distance = 0.4 * filtered.delta;
  const auto labels = label_points(cloud, filtered, walls, tree, max_distance);
  std::size_t labelled = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] < 0) continue;
    ++labelled;
    CHECK(std::abs(walls[static_cast<std::size_t>(labels[i])].fit.plane.signed_distance(
              cloud.points[i].cast<double>())) < max_distance);
  }
  CHECK(static_cast<double>(labelled) > 0.98 * static_cast<double>(labels.size()));
}
