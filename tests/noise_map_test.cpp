// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "noise_map.h"

#include "reconstruct.h"
#include "rival/windows.h"
#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

// A floor of 8 x 3 m. Its noise grows along x from this to three times as much.
PointCloud growing_noise(double least) {
  PointCloud cloud;
  Random random(3);
  for (double x = 0; x < 8; x += 0.02)
    for (double y = 0; y < 3; y += 0.02)
      cloud.points.emplace_back(Vec3(x, y, least * (1 + x / 4) * random.gauss()).cast<float>());
  return cloud;
}

// A room of 6 x 5 x 2.6 m as a scanner in it sees it, which turns in equal steps: the noise is
// along the ray, and points are densest above it.
PointCloud scanned_room(const Vec3& from, double noise, std::uint64_t seed) {
  const Vec3 size(6, 5, 2.6);
  PointCloud cloud;
  Random random(seed);
  const double step = 0.0044;
  for (double up = -M_PI / 3; up < M_PI / 2; up += step)
    for (double turn = 0; turn < 2 * M_PI; turn += step) {
      const Vec3 ray(std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up));
      double range = 1e9;
      for (int a = 0; a < 3; ++a)
        if (std::abs(ray[a]) > 1e-9)
          range = std::min(range, ((ray[a] > 0 ? size[a] : 0) - from[a]) / ray[a]);
      cloud.points.push_back((from + (range + noise * random.gauss()) * ray).cast<float>());
    }
  return cloud;
}

}  // namespace

TEST_CASE("noise that grows along a floor leaves it one surface, and is told from place to place") {
  for (double least : {0.003, 0.006}) {
    CAPTURE(least);
    const Stages s = run_stages(growing_noise(least));
    const Clustering c = s.confirm();
    REQUIRE(c.clusters.size() == 1);
    const std::vector<NoiseSample> samples = sample_noise(s.grid, c);
    REQUIRE(samples.size() > 100);
    int right = 0;
    for (const NoiseSample& sample : samples) {
      const double ratio = sample.noise / (least * (1 + sample.at.x() / 4));
      right += ratio > 0.75 && ratio < 1.25;
    }
    CHECK(right > 0.95 * static_cast<double>(samples.size()));
    const NoiseMap map = map_noise(s.grid, s.scale, samples);
    CHECK(map.at({0.5, 1.5, 0}) == 0);  // no more than the scan's
    for (double x = 0; x < 8; x += 0.25) CHECK(map.at({x, 1.5, 0}) < 3.5 * least);
    CHECK(map.largest() > s.scale.noise);
    CHECK(map.largest() <= 2 * s.scale.noise);
    const NoiseModel model = describe_noise(samples, {});
    CHECK(model.low < 0.6 * model.high);
    CHECK(model.at_range.empty());
  }
}

TEST_CASE("noise along the ray is told by the incidence of the rays") {
  const Vec3 from(2, 2.5, 1.5);
  const double noise = 0.006;
  Stages s = run_stages(scanned_room(from, noise, 1));
  const std::vector<NoiseSample> samples = sample_noise(s.grid, s.confirm());
  const std::vector<NoiseAtRange> all = noise_by_range(samples, std::vector<Vec3>{from});
  REQUIRE(all.size() > 3);
  for (const NoiseAtRange& n : all) {
    const double square_on = noise * std::cos(n.min_incidence);
    const double slant = noise * std::cos(n.max_incidence);
    if (n.area < 1) continue;
    CHECK(n.noise > 0.8 * slant);
    CHECK(n.noise < 1.1 * square_on);
  }
}

TEST_CASE("an empty room has six surfaces and no obstacle where the scanner stood") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Vec3 from(random.uniform(1.5, 4.5), random.uniform(1.5, 3.5), random.uniform(1.3, 1.8));
    const World world = reconstruct(scanned_room(from, 0.006, seed)).world;
    CHECK(world.surfaces.size() == 6);
    CHECK(world.obstacles.empty());
  }
}

TEST_CASE("a map of noise holds medians of what is around, between its bounds") {
  std::vector<NoiseSample> samples;
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < 10; ++y)
      samples.push_back({.at = Vec3(x + 0.5, y + 0.5, 0.5), .noise = x < 5 ? 1.0 : 3.0});
  samples[0].noise = 100;
  const NoiseMap map(samples, 1, 1.5, 2);
  CHECK(map.at({0.5, 0.5, 0.5}) == 0);
  CHECK(map.at({2.5, 4.5, 0.5}) == 0);
  CHECK(map.at({7.5, 4.5, 0.5}) == 2);
  CHECK(map.at({7.5, 4.5, 5}) == 0);
  CHECK(map.at({1e9, 0, 0}) == 0);
  CHECK(map.largest() == 2);
  CHECK(NoiseMap().at({0, 0, 0}) == 0);
  CHECK(noise_by_range(samples, {}).empty());
}

TEST_CASE("the range of noise is that of the viewpoint that saw it, where it is known") {
  const std::vector<Vec3> viewpoints = {{0.5, 0, 0}, {5, 0, 0}};
  const auto range_for = [&](std::int32_t viewer) {
    const std::vector<NoiseSample> samples = {
        {.normal = Vec3::UnitX(), .noise = 0.01, .area = 1, .viewer = viewer}};
    return noise_by_range(samples, viewpoints)[0].max_range;
  };
  CHECK(range_for(-1) == 1);
  CHECK(range_for(0) == 1);
  CHECK(range_for(1) == 8);
}
