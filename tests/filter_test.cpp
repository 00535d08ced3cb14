// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "thesis/filter.h"

#include <algorithm>
#include <map>

#include "support/scenes.h"
#include "thesis/extent.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::thesis;

namespace {

PointCloud with(PointCloud cloud, const std::vector<Vec3>& more) {
  for (const Vec3& p : more) cloud.points.push_back(p.cast<float>());
  return cloud;
}

}  // namespace

TEST_CASE(
    "each cube with more than the least count gives the component-wise median of its points, by "
    "brute force") {
  Random random(1);
  PointCloud cloud;
  for (int i = 0; i < 4000; ++i)
    cloud.points.push_back(
        Vec3(random.uniform(0, 2), random.uniform(0, 1), random.uniform(0, 1)).cast<float>());
  cloud.points.push_back(Vec3f(0, 0, 0));
  cloud.points.push_back(Vec3f(2, 1, 1));
  const FilterOptions options{.points_per_dimension = 8, .min_points = 14};
  const FilteredPoints filtered = filter_points(cloud, options);
  CHECK(filtered.delta == doctest::Approx(2.0 / 8));

  std::map<std::array<int, 3>, std::vector<std::size_t>> cubes;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    std::array<int, 3> cube{};
    for (int k = 0; k < 3; ++k)
      cube[static_cast<std::size_t>(k)] =
          static_cast<int>(std::floor(static_cast<double>(cloud.points[i][k]) / filtered.delta));
    cubes[cube].push_back(i);
  }
  std::vector<Vec3> expected;
  for (const auto& [cube, members] : cubes) {
    if (members.size() <= 14) {
      for (std::size_t i : members) CHECK(filtered.from_input[i] == -1);
      continue;
    }
    Vec3 median;
    for (int k = 0; k < 3; ++k) {
      std::vector<float> values;
      for (std::size_t i : members) values.push_back(cloud.points[i][k]);
      std::sort(values.begin(), values.end());
      median[k] = values[values.size() / 2];
    }
    for (std::size_t i : members)
      CHECK(filtered.from_input[i] == static_cast<int>(expected.size()));
    expected.push_back(median);
  }
  CHECK(filtered.points == expected);
  CHECK(expected.size() > 20);
}

TEST_CASE("delta is the longest extent divided by the points in one dimension") {
  const PointCloud cloud = room_points({6, 3, 2}, 0.04, 0);
  CHECK(filter_points(cloud, {.points_per_dimension = 100}).delta ==
        doctest::Approx(0.06).scale(0).epsilon(0.01));
  CHECK(filter_points(cloud, {.points_per_dimension = 50}).delta ==
        doctest::Approx(0.12).scale(0).epsilon(0.01));
}

TEST_CASE("by density, a cube in the plane of a wall holds about the points asked for") {
  for (double spacing : {0.02, 0.03, 0.05}) {
    const PointCloud cloud = room_points({5, 4, 2.7}, spacing, 0.005);
    const FilteredPoints filtered = filter_points(cloud, {.points_per_cube = 8, .min_size = 0});
    const double points_in_cube = std::pow(filtered.delta / spacing, 2);
    CHECK(points_in_cube > 4);
    CHECK(points_in_cube < 16);
  }
  CHECK(filter_points(room_points({3, 2, 2}, 0.005, 0), {.min_size = 0.05}).delta == 0.05);
}

TEST_CASE("a point far away changes nothing, wherever it is, and a few do not either") {
  const PointCloud cloud = room_points({5, 4, 2.7}, 0.04, 0.005);
  for (const FilterOptions& options :
       {FilterOptions{}, FilterOptions{.points_per_dimension = 100}}) {
    const FilteredPoints before = filter_points(cloud, options);
    for (const Vec3& stray : {Vec3(1000, 0, 0), Vec3(0, -1000, 3), Vec3(700, 700, 700),
                              Vec3(0, 0, 1e6), Vec3(-30, 2, 1)}) {
      const FilteredPoints after = filter_points(with(cloud, {stray}), options);
      CHECK(after.delta == before.delta);
      CHECK(after.points == before.points);
    }
    const FilteredPoints after =
        filter_points(with(cloud, {{1000, 0, 0}, {0, 1000, 0}, {-500, 2, 800}}), options);
    CHECK(after.points == before.points);
  }
}

TEST_CASE("the order of the points does not matter") {
  PointCloud cloud = room_points({5, 4, 2.7}, 0.04, 0.005);
  const FilteredPoints before = filter_points(cloud);
  shuffle_points(cloud, 9);
  const FilteredPoints after = filter_points(cloud);
  CHECK(after.delta == before.delta);
  CHECK(after.points == before.points);
}

TEST_CASE(
    "scans without extent or with few points are filtered to nothing or little, without fuss") {
  CHECK(filter_points({}).points.empty());
  CHECK(filter_points(cloud_of({{1, 2, 3}})).points.size() <= 1);
  CHECK(filter_points(cloud_of(std::vector<Vec3>(100000, Vec3(1, 2, 3)))).points.size() <= 1);
  CHECK(
      filter_points(cloud_of(std::vector<Vec3>(1000, Vec3(1, 2, 3))), {.points_per_dimension = 100})
          .points.size() <= 1);
  std::vector<Vec3> line;
  for (int i = 0; i < 1000; ++i) line.emplace_back(0.01 * i, 0, 0);
  CHECK(filter_points(cloud_of(line)).points.size() > 10);
}

TEST_CASE("copies of one point do not make the cubes small") {
  const PointCloud cloud = room_points({5, 4, 2.7}, 0.04, 0.005);
  const double before = filter_points(cloud).delta;
  const double after = filter_points(with(cloud, std::vector<Vec3>(5000, Vec3(2, 2, 1)))).delta;
  CHECK(after == doctest::Approx(before).scale(0).epsilon(0.1));
}

TEST_CASE("a depth camera's scan is filtered in cubes of two depth steps at its far end") {
  PointCloud cloud;
  Random random(1);
  add_rectangle(cloud, {-1, -1, 5}, {2, 0, 0}, {0, 2, 0}, 0.005, 0.01, random);
  cloud.viewpoints = {Vec3::Zero()};
  const double far = std::hypot(5, 1.3);
  CHECK(filter_points(cloud, {.depth_step = 0.003}).delta ==
        doctest::Approx(2 * 0.003 * far * far).scale(0).epsilon(0.05));
  CHECK(filter_points(cloud).delta == 0.05);
}
