// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/scale.h"

#include "parallel.h"
#include "support/scenes.h"
#include "world/virtual_scan.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

bool same(const Scale& a, const Scale& b) {
  return a.noise == b.noise && a.spacing == b.spacing && a.voxel == b.voxel;
}

// A floor and two walls as a depth camera at `camera` sees them, its noise growing with range.
PointCloud depth_points(double step, const Vec3& camera = Vec3::Zero()) {
  PointCloud cloud;
  Random random(1);
  for (int i = 0; i < 240; ++i)
    for (int k = 0; k < 320; ++k) {
      const Vec3 ray((k - 159.5) / 280, (i - 119.5) / 280, 1);
      double z = std::min(4.5 - 0.8 * ray.x(), 1.1 / std::max(ray.y(), 1e-3));
      z = std::min(z, 1.5 / std::max(-ray.x(), 1e-3));
      z += step * (z * ray).squaredNorm() * random.gauss();
      cloud.points.push_back((camera + z * ray).cast<float>());
    }
  cloud.viewpoints = {camera};
  return cloud;
}

}  // namespace

TEST_CASE("noise and spacing of a room are found, the voxel follows from them") {
  for (double noise : {0.002, 0.005, 0.01, 0.02, 0.03})
    for (double spacing : {0.02, 0.035}) {
      CAPTURE(noise);
      CAPTURE(spacing);
      const Scale scale = estimate_scale(room_points({5, 4, 2.7}, spacing, noise));
      CHECK(scale.noise == doctest::Approx(noise).scale(0).epsilon(0.2));
      CHECK(scale.spacing == doctest::Approx(spacing).scale(0).epsilon(0.3));
      CHECK(scale.voxel == std::max({0.02, 1.5 * scale.spacing, 3 * scale.noise}));
    }
}

TEST_CASE("the scale depends neither on the order of the points nor on threads nor on a stray") {
  PointCloud cloud = room_points({5, 4, 2.7}, 0.03, 0.007);
  const Scale before = estimate_scale(cloud);
  for (int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    shuffle_points(cloud, 1);
    CHECK(same(estimate_scale(cloud), before));
  }
  // So dense that not all points of a cell are looked at.
  PointCloud dense;
  Random random(2);
  add_rectangle(dense, {0, 0, 0.07}, {2, 0, 0}, {0, 2, 0}, 0.006, 0.01, random);
  const Scale seen = estimate_scale(dense);
  shuffle_points(dense, 3);
  CHECK(same(estimate_scale(dense), seen));
  for (const Vec3f& stray : {Vec3f(1000, 0, 0), Vec3f(-3e38f, 3e38f, 0), Vec3f(0, 1e7f, 0)}) {
    cloud.points.push_back(stray);
    CHECK(same(estimate_scale(cloud), before));
    cloud.points.pop_back();
  }
}

TEST_CASE("a scan is in the same units as its scale") {
  PointCloud cloud = room_points({5, 4, 2.7}, 0.03, 0.007);
  const Scale before = estimate_scale(cloud);
  for (Vec3f& p : cloud.points) p *= 16;
  const Scale after = estimate_scale(cloud);
  CHECK(after.noise == doctest::Approx(16 * before.noise).scale(0).epsilon(0.1));
  CHECK(after.spacing == doctest::Approx(16 * before.spacing).scale(0).epsilon(0.1));
}

TEST_CASE("an exactly flat scan has the least noise, and so has one without planes") {
  PointCloud flat;
  Random random(1);
  add_rectangle(flat, {0, 0, 0.07}, {4, 0, 0}, {0, 4, 0}, 0.03, 0, random);
  const Scale scale = estimate_scale(flat);
  CHECK(scale.noise == ScaleOptions().min_noise);
  CHECK(scale.spacing == doctest::Approx(0.03).scale(0).epsilon(0.3));
  CHECK(estimate_scale(flat, {.min_noise = 0.002}).noise == 0.002);
  for (const PointCloud& cloud :
       {PointCloud(), cloud_of({{1, 2, 3}}), cloud_of(std::vector<Vec3>(50000, Vec3(1, 2, 3)))}) {
    CHECK(estimate_scale(cloud).noise == ScaleOptions().min_noise);
    CHECK(estimate_scale(cloud).voxel == ScaleOptions().min_voxel);
  }
}

TEST_CASE("lengths that are given are taken") {
  const PointCloud cloud = room_points({5, 4, 2.7}, 0.04, 0.005);
  const Scale seen = estimate_scale(cloud);
  const Scale all = estimate_scale(cloud, {.noise = 0.011, .spacing = 0.022, .voxel = 0.066});
  CHECK(all.noise == 0.011);
  CHECK(all.spacing == 0.022);
  CHECK(all.voxel == 0.066);
  const Scale noise = estimate_scale(cloud, {.noise = 0.05});
  CHECK(noise.spacing == doctest::Approx(0.04).scale(0).epsilon(0.1));
  CHECK(noise.voxel == doctest::Approx(0.15));
  CHECK(estimate_scale(cloud, {.spacing = 0.1}).noise == seen.noise);
}

TEST_CASE("a depth camera's noise grows with the square of the range from where it was") {
  const double step = 0.0015;
  for (const Vec3& camera : {Vec3(0, 0, 0), Vec3(3, -2, 1)}) {
    const PointCloud cloud = depth_points(step, camera);
    const Scale scale = estimate_scale(cloud, {.depth_step = step});
    for (double range : {3.0, 4.0, 5.0})
      CHECK(scale.noise_at(camera + Vec3(0, 0, range)) ==
            doctest::Approx(step * range * range).scale(0).epsilon(0.01));
    CHECK(scale.noise_at(camera) == scale.noise);
    CHECK(scale.variance_at(camera) == scale.noise * scale.noise);
    // What the model explains is not noise again.
    CHECK(scale.noise < 0.7 * estimate_scale(cloud).noise);
  }
}

TEST_CASE("the noise of a single plane is found at any height, also where cells end") {
  for (double z : {0.0, 0.02, 0.05, 0.0945, 0.15, 1.0}) {
    PointCloud flat;
    Random random(1);
    add_rectangle(flat, {0, 0, z}, {3, 0, 0}, {0, 3, 0}, 0.01, 0.006, random);
    CHECK(estimate_scale(flat).noise == doctest::Approx(0.006).scale(0).epsilon(0.15));
  }
}

TEST_CASE("noise that the smallest cells cannot show is found all the same") {
  const World room = read_world(in_project("worlds/room.json"));
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const VirtualScan scan = virtual_scan(room, {.noise = 0.03, .seed = seed});
    // Off the surfaces there is less of it than along the rays.
    CHECK(estimate_scale(scan.cloud).noise == doctest::Approx(0.025).scale(0).epsilon(0.2));
  }
}

TEST_CASE("points at one place have no noise and no spacing that could be seen") {
  PointCloud cloud;
  cloud.points.assign(10000, Vec3f(1, 2, 3));
  const Scale scale = estimate_scale(cloud);
  CHECK(scale.noise == ScaleOptions{}.min_noise);
  CHECK(scale.spacing == 0);
  CHECK(scale.voxel == ScaleOptions{}.min_voxel);
}
