// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/sides.h"

#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

// Both sides of a wall, tilted, around the plane through the origin with this normal.
const Vec3 kNormal = Vec3(0.3, 0.9, 0.1).normalized();

PointCloud thin_wall(double thickness, double noise, bool with_normals, std::uint64_t seed = 1) {
  PointCloud cloud;
  Random random(seed);
  const PlaneFrame frame = frame_of({kNormal, 0});
  for (double side : {-0.5, 0.5}) {
    add_rectangle(cloud, side * thickness * kNormal, 2 * frame.u, 2 * frame.v, 0.015, noise,
                  random);
    if (with_normals)
      cloud.normals.resize(cloud.points.size(), (side < 0 ? -kNormal : kNormal).cast<float>());
  }
  return cloud;
}

// Two clusters, each with the points of one side.
void check_two_sides(const Stages& s, double mixed = 0.03) {
  const Clustering c = s.grow();
  check_clustering(s.grid, c);
  std::vector<std::array<double, 2>> of_side(c.clusters.size());
  for (std::size_t i = 0; i < s.grid.sites.size(); ++i)
    if (c.label[i] != kNone)
      for (std::uint32_t p : s.grid.points_of(i))
        ++of_side[static_cast<std::size_t>(c.label[i])][p >= s.cloud.points.size() / 2];
  std::sort(of_side.begin(), of_side.end(),
            [](const auto& a, const auto& b) { return a[0] + a[1] > b[0] + b[1]; });
  const double half = static_cast<double>(s.cloud.points.size()) / 2;
  REQUIRE(of_side.size() >= 2);
  for (const auto& n : {of_side[0], of_side[1]}) {
    CHECK(std::max(n[0], n[1]) > 0.85 * half);
    CHECK(std::min(n[0], n[1]) < mixed * half);
  }
  CHECK((of_side[0][0] > of_side[0][1]) != (of_side[1][0] > of_side[1][1]));
}

}  // namespace

TEST_CASE("the two sides of a wall of 3 cm are two clusters") {
  for (double noise : {0.003, 0.006})
    for (std::uint64_t seed : {1u, 2u}) {
      CAPTURE(noise);
      check_two_sides(run_stages(thin_wall(0.03, noise, false, seed), known_scale(noise, 0.015)));
    }
}

TEST_CASE("with normals they are two in more noise too") {
  // At 10 mm, 7 % of the points are beyond the middle of the wall.
  for (const auto& [noise, mixed] : {std::pair(0.003, 0.01), {0.006, 0.03}, {0.01, 0.12}}) {
    CAPTURE(noise);
    check_two_sides(run_stages(thin_wall(0.03, noise, true), known_scale(noise, 0.015)), mixed);
  }
}

TEST_CASE("without parting them they would be mixed") {
  const Stages s = run_stages(thin_wall(0.03, 0.006, false), known_scale(0.006, 0.015), false);
  const Clustering c = s.grow();
  std::size_t mixed = 0;
  for (std::size_t i = 0; i < s.grid.sites.size(); ++i) {
    int of_side[2] = {};
    for (std::uint32_t p : s.grid.points_of(i)) ++of_side[p >= s.cloud.points.size() / 2];
    mixed += of_side[0] > 0 && of_side[1] > 0;
  }
  CHECK(mixed > s.grid.sites.size() / 4);
  CHECK(s.grid.separators.empty());
}

TEST_CASE("a single wall is not parted, with or without normals") {
  for (double noise : {0.0005, 0.003, 0.006, 0.01, 0.03})
    for (bool with_normals : {false, true}) {
      CAPTURE(noise);
      PointCloud cloud;
      Random random(3);
      const PlaneFrame frame = frame_of({kNormal, 0});
      add_rectangle(cloud, frame.origin, 3 * frame.u, 3 * frame.v, 0.02, noise, random);
      if (with_normals) cloud.normals.resize(cloud.points.size(), kNormal.cast<float>());
      CHECK(run_stages(cloud, known_scale(noise, 0.02)).grid.separators.empty());
    }
}

TEST_CASE("a step of the floor leaves two floors") {
  for (double height : {0.03, 0.1}) {
    CAPTURE(height);
    PointCloud cloud;
    Random random(4);
    add_rectangle(cloud, {0, 0, 0}, {1.5, 0, 0}, {0, 2, 0}, 0.015, 0.003, random);
    add_rectangle(cloud, {1.5, 0, height}, {1.5, 0, 0}, {0, 2, 0}, 0.015, 0.003, random);
    const std::size_t half = cloud.points.size() / 2;
    const Stages s = run_stages(cloud, known_scale(0.003, 0.015));
    const Clustering c = s.confirm();
    check_clustering(s.grid, c);
    CHECK(c.clusters.size() == 2);
    std::array<double, 2> right{};
    for (std::size_t i = 0; i < s.grid.sites.size(); ++i)
      if (c.label[i] != kNone)
        for (std::uint32_t p : s.grid.points_of(i)) {
          const double z = c.clusters[static_cast<std::size_t>(c.label[i])].fit.centroid.z();
          right[p >= half] += std::abs(z - (p >= half ? height : 0)) < 0.005;
        }
    for (double n : right) CHECK(n > 0.97 * static_cast<double>(half));
  }
}
