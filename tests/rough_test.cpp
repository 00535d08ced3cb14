// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/rough.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "parallel.h"
#include "reconstruct.h"
#include "support/stages.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

const Vec3 kRoughRoom(5, 4, 2.7);  // [m]

// A random relief of this height (rms) that goes up and down over this length [m].
class Relief {
 public:
  Relief(double height, double length, Random& random) : height_(height * std::sqrt(2.0 / kWaves)) {
    for (int k = 0; k < kWaves; ++k)
      waves_.push_back({random.gauss() / length, random.gauss() / length, random.gauss() / length,
                        random.uniform(0, 2 * M_PI)});
  }
  double at(const Vec3& p) const {
    double sum = 0;
    for (const auto& [a, b, c, phase] : waves_)
      sum += std::cos(a * p.x() + b * p.y() + c * p.z() + phase);
    return height_ * sum;
  }

 private:
  static constexpr int kWaves = 60;
  double height_;
  std::vector<std::array<double, 4>> waves_;
};

// The points of a room whose walls, but not floor and ceiling, are rough; where `has_door`, without
// those of the wall y = 0 that are behind a smooth door 6 cm before it.
PointCloud rough_room(double height, double length, std::uint64_t seed, bool has_door = false) {
  Random random(seed);
  const Relief relief(height, length, random);
  PointCloud cloud = room_points(kRoughRoom, 0.04, 0.002, seed);
  std::erase_if(cloud.points, [&](const Vec3f& p) {
    return has_door && p.x() > 1 && p.x() < 2 && p.z() < 2 && p.z() > 0.02f && p.y() < 0.01f;
  });
  for (Vec3f& point : cloud.points) {
    const Vec3 p = point.cast<double>();
    for (int axis : {0, 1})
      if (std::min(p[axis], kRoughRoom[axis] - p[axis]) < 0.01 && p.z() > 0.01 &&
          p.z() < kRoughRoom.z() - 0.01)
        point[axis] += static_cast<float>(relief.at(p));
  }
  if (has_door)
    add_rectangle(cloud, {1, 0.06, 0}, Vec3::UnitX(), 2 * Vec3::UnitZ(), 0.02, 0.002, random);
  return cloud;
}

// How many surfaces of this kind a world has.
std::ptrdiff_t count_kind(const World& world, Kind kind) {
  return std::count_if(world.surfaces.begin(), world.surfaces.end(),
                       [&](const Surface& s) { return s.kind == kind; });
}

}  // namespace

TEST_CASE("a room with rough walls has four walls, a floor, a ceiling, and is a room") {
  std::uint64_t seed = 1;
  for (double height : {0.01, 0.02, 0.03})
    for (double length : {0.04, 0.06}) {
      CAPTURE(height);
      CAPTURE(length);
      const World world = reconstruct(rough_room(height, length, seed++)).world;
      CHECK(count_kind(world, Kind::wall) == 4);
      CHECK(count_kind(world, Kind::floor) == 1);
      CHECK(count_kind(world, Kind::ceiling) == 1);
      CHECK(world.surfaces.size() == 6);
      CHECK(world.obstacles.empty());
      REQUIRE(world.rooms.size() == 1);
      CHECK(world.rooms[0].area.value() == doctest::Approx(20).epsilon(0.03));
    }
}

TEST_CASE("without a roughness to look for, rough walls are lost") {
  ReconstructOptions smooth;
  smooth.rival.rough.max_roughness = 0;
  CHECK(count_kind(reconstruct(rough_room(0.02, 0.1, 7), smooth).world, Kind::wall) < 4);
}

TEST_CASE("a smooth door in a rough wall stays a surface of its own") {
  for (std::uint64_t seed : {11, 12, 13}) {
    CAPTURE(seed);
    const World world = reconstruct(rough_room(0.015, 0.06, seed, true)).world;
    const auto is_door = [&](const Surface& s) {
      return std::abs(s.plane.signed_distance({1.5, 0.06, 1})) < 0.005 &&
             std::abs(s.plane.normal.y()) > 0.99 && std::abs(area(world, s) - 2) < 0.2;
    };
    CHECK(std::count_if(world.surfaces.begin(), world.surfaces.end(), is_door) == 1);
    CHECK(std::any_of(world.surfaces.begin(), world.surfaces.end(), [&](const Surface& s) {
      return std::abs(s.plane.signed_distance({1.5, 0, 1})) < 0.01 && area(world, s) > 9;
    }));
  }
}

TEST_CASE("in a smooth room with bushes nothing is found that would not be without") {
  for (std::uint64_t seed : {21, 22}) {
    CAPTURE(seed);
    PointCloud cloud = room_points(kRoughRoom, 0.03, 0.004, seed);
    Random random(seed);
    for (int bush = 0; bush < 2; ++bush)
      for (int k = 0; k < 12000; ++k) {
        const double depth = 1 - std::abs(random.gauss()) / 4;
        const Vec3 center(1.2 + 2.5 * bush, 2, 1.2);
        cloud.points.push_back((center + depth * random.direction()).cast<float>());
      }
    ReconstructOptions smooth;
    smooth.rival.rough.max_roughness = 0;
    const ReconstructResult with = reconstruct(cloud);
    CHECK(with.labels == reconstruct(cloud, smooth).labels);
  }
}

TEST_CASE("rough walls are the same for any threads and order of the points") {
  PointCloud cloud = rough_room(0.02, 0.06, 31, true);
  const std::string before = world_text(reconstruct(cloud).world);
  for (int threads : {1, 2, 3}) {
    const ThreadLimit limit(threads);
    CHECK(world_text(reconstruct(cloud).world) == before);
  }
  shuffle_points(cloud, 1);
  CHECK(world_text(reconstruct(cloud).world) == before);
}

TEST_CASE("roughness is looked for from little to most, above noise alone") {
  const RoughOptions options;
  for (double noise : {0.001, 0.003, 0.008, 0.019, 0.05}) {
    CAPTURE(noise);
    const std::vector<double> list = list_roughness({.noise = noise, .voxel = 0.02}, options);
    CHECK(std::is_sorted(list.begin(), list.end()));
    CHECK(list.empty() == (options.min_roughness * noise >= options.max_roughness));
    for (double roughness : list) CHECK(roughness > options.min_roughness * noise);
    if (!list.empty()) CHECK(list.back() == options.max_roughness);
  }
  CHECK(list_roughness({.noise = 0.001, .voxel = 0.02}, {.max_roughness = 0}).empty());
}

TEST_CASE("what is left are the sites in no cluster") {
  const Stages s = run_stages(rough_room(0.02, 0.1, 41));
  const Clustering c = s.confirm();
  const Leftover left = find_leftover(s.grid, s.neighbors, c);
  REQUIRE(left.sites.size() == left.places.points.size());
  CHECK(left.sites.size() ==
        static_cast<std::size_t>(std::count(c.label.begin(), c.label.end(), kNone)));
  for (std::size_t k = 0; k < left.sites.size(); ++k) {
    CHECK(c.label[left.sites[k]] == kNone);
    CHECK(left.places.points[k] == s.grid.sites[left.sites[k]].mean);
  }
}
