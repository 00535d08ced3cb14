// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/evidence.h"

#include <cmath>
#include <set>

#include "reconstruct.h"
#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

constexpr double kBandSpacing = 0.015;

PointCloud floor_points(double noise, Random& random) {
  PointCloud cloud;
  add_rectangle(cloud, {-1.5, -1.5, 0}, {3, 0, 0}, {0, 3, 0}, kBandSpacing, noise, random);
  return cloud;
}

void add_sphere(PointCloud& cloud, const Vec3& center, double radius, double noise,
                Random& random) {
  const int count = static_cast<int>(4 * M_PI * radius * radius / (kBandSpacing * kBandSpacing));
  for (int i = 0; i < count; ++i)
    cloud.points.push_back(
        (center + (radius + noise * random.gauss()) * random.direction()).cast<float>());
}

// A column of 1.5 m on a floor.
PointCloud column_points(double radius, double noise, Random& random) {
  PointCloud cloud = floor_points(noise, random);
  std::erase_if(cloud.points, [&](const Vec3f& p) { return p.head<2>().norm() < radius; });
  const double height = 1.5;
  const int count = static_cast<int>(2 * M_PI * radius * height / (kBandSpacing * kBandSpacing));
  for (int i = 0; i < count; ++i) {
    const double angle = random.uniform(0, 2 * M_PI), r = radius + noise * random.gauss();
    cloud.points.push_back(
        Vec3(r * std::cos(angle), r * std::sin(angle), random.uniform(0, height)).cast<float>());
  }
  return cloud;
}

void add_box(PointCloud& cloud, const Vec3& center, double edge, double noise, Random& random) {
  const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis)
    for (double side : {-0.5, 0.5}) {
      const Vec3 a = edge * turn.col((axis + 1) % 3), b = edge * turn.col((axis + 2) % 3);
      add_rectangle(cloud, center + side * edge * turn.col(axis) - 0.5 * a - 0.5 * b, a, b,
                    kBandSpacing, noise, random);
    }
}

// What all stages find, without the floor.
std::size_t found_beside_floor(PointCloud cloud, double noise) {
  const Stages s = run_stages(std::move(cloud), known_scale(noise, kBandSpacing));
  const Clustering c = s.confirm();
  check_clustering(s.grid, c);
  std::size_t floors = 0, others = 0;
  for (const rival::Cluster& k : c.clusters)
    ++(std::abs(k.fit.plane.normal.z()) > 0.999 && std::abs(k.fit.centroid.z()) < noise ? floors
                                                                                        : others);
  CHECK(floors == 1);
  return others;
}

// Weighs the sites of one plane as they are; tells whether they are kept.
bool is_kept(const Stages& s, const EvidenceOptions& options = {}) {
  const Clustering start = label_sites(s.grid, [](const Vec3&) { return 0; });
  const Clustering c = weigh_evidence(s.grid, s.neighbors, s.scale, start, options);
  const auto kept = std::count(c.label.begin(), c.label.end(), 0);
  CHECK((kept == 0 || kept == static_cast<std::ptrdiff_t>(c.label.size())));
  return kept > 0;
}

Stages plate(double width, double height, double spacing, double noise) {
  PointCloud cloud;
  Random random(7);
  const PlaneFrame frame = frame_of({Vec3(1, 2, 3).normalized(), 0});
  add_rectangle(cloud, frame.origin, width * frame.u, height * frame.v, spacing, noise, random);
  return run_stages(std::move(cloud), known_scale(noise, spacing));
}

}  // namespace

TEST_CASE("spheres have no planes") {
  Random random(1);
  for (double noise : {0.003, 0.01})
    for (double radius : {0.15, 0.25, 0.35, 0.5}) {
      CAPTURE(noise);
      CAPTURE(radius);
      PointCloud cloud = floor_points(noise, random);
      add_sphere(cloud, {0, 0, radius + 0.3}, radius, noise, random);
      CHECK(found_beside_floor(cloud, noise) == 0);
    }
}

TEST_CASE("round columns are no planes once round parts are found") {
  Random random(2);
  for (double noise : {0.002, 0.003, 0.005, 0.01})
    for (double radius : {0.15, 0.2, 0.25, 0.35, 0.5}) {
      CAPTURE(noise);
      CAPTURE(radius);
      const PointCloud cloud = column_points(radius, noise, random);
      const std::vector<std::int32_t> labels = reconstruct(cloud).labels;
      std::size_t on_column = 0, in_planes = 0;
      for (std::size_t i = 0; i < labels.size(); ++i)
        if (cloud.points[i].z() > 0.1) ++on_column, in_planes += labels[i] >= 0;
      CHECK(in_planes < on_column / 20);
    }
}

TEST_CASE("a box of 30 cm has its six faces") {
  Random random(3);
  for (double noise : {0.003, 0.006}) {
    CAPTURE(noise);
    PointCloud cloud = floor_points(noise, random);
    add_box(cloud, {0, 0, 0.8}, 0.3, noise, random);
    CHECK(found_beside_floor(cloud, noise) == 6);
  }
}

TEST_CASE("plates are kept that have the points and the area") {
  CHECK(is_kept(plate(0.4, 0.4, 0.02, 0.004)));
  CHECK_FALSE(is_kept(plate(0.4, 0.4, 0.02, 0.004), {.min_points = 1000}));
  CHECK_FALSE(is_kept(plate(0.4, 0.4, 0.02, 0.004), {.min_area = 0.5}));
  CHECK_FALSE(is_kept(plate(0.05, 0.05, 0.005, 0.002)));
  CHECK_FALSE(is_kept(plate(0.4, 0.4, 0.02, 0.03)));  // lost in the noise
  CHECK(is_kept(plate(0.6, 0.6, 0.02, 0.03)));
}

TEST_CASE(
    "far walls are planes, however sparse, if nothing lies beside them and they do not bend") {
  Stages sparse = plate(3, 3, 0.2, 0.004);
  CHECK(is_kept(sparse));
  sparse.scale.spacing = 0.02;
  CHECK(is_kept(sparse));
  CHECK_FALSE(is_kept(sparse, {.min_sparse_points = 300}));
  CHECK(is_kept(sparse, {.sparse_points = 80, .min_sparse_points = 300}));
  PointCloud bowl;
  Random random(8);
  for (int i = 0; i < 250; ++i) {
    const double x = random.uniform(-1.5, 1.5), y = random.uniform(-1.5, 1.5);
    bowl.points.push_back(Vec3(x, y, 0.02 * (x * x + y * y)).cast<float>());
  }
  Stages bent = run_stages(bowl, known_scale(0.02, 0.2));
  bent.scale.spacing = 0.02;
  CHECK_FALSE(is_kept(bent));
  CHECK(is_kept(bent, {.max_curvature = 1}));
}

TEST_CASE("strays all over a place are no plane, though some lie in one") {
  Random random(9);
  PointCloud cloud;
  for (int i = 0; i < 4000; ++i)
    cloud.points.push_back(
        Vec3(random.uniform(0, 4), random.uniform(0, 4), random.uniform(-0.5, 0.5)).cast<float>());
  Stages s = run_stages(std::move(cloud), known_scale(0.01, 0.1), false);
  s.scale.spacing = 0.02;
  const Clustering start =
      label_sites(s.grid, [](const Vec3& p) { return std::abs(p.z()) < 0.03 ? 0 : kNone; });
  REQUIRE(start.clusters[0].moments.n > EvidenceOptions().min_sparse_points);
  const auto kept = [&](const EvidenceOptions& options) {
    const Clustering c = weigh_evidence(s.grid, s.neighbors, s.scale, start, options);
    return std::count(c.label.begin(), c.label.end(), 0) > 0;
  };
  CHECK_FALSE(kept({}));
  CHECK(kept({.min_purity = 0}));
}

TEST_CASE("a layer in the noise of a larger cluster goes, one behind it stays") {
  for (double height : {0.0, 0.05}) {
    PointCloud cloud;
    Random random(4);
    add_rectangle(cloud, {0, 0, 0}, {3, 0, 0}, {0, 3, 0}, 0.02, 0.005, random);
    if (height > 0) add_rectangle(cloud, {1, 1, height}, {1, 0, 0}, {0, 1, 0}, 0.02, 0.005, random);
    RivalOptions options = known_scale(0.005, 0.02);
    options.scale.voxel = 0.02;
    const Stages s = run_stages(std::move(cloud), options, false);
    const auto layer = [&](const Vec3& p) {
      const bool inside = p.x() > 1 && p.x() < 2 && p.y() > 1 && p.y() < 2;
      return inside && p.z() > (height > 0 ? height / 2 : 0.002) ? 1 : 0;
    };
    const Clustering c = weigh_evidence(s.grid, s.neighbors, s.scale, label_sites(s.grid, layer));
    CHECK(std::count(c.label.begin(), c.label.end(), 0) > 5000);
    CHECK((std::count(c.label.begin(), c.label.end(), 1) > 0) == (height > 0));
  }
}

TEST_CASE("each trait moves the odds to the side that it speaks for") {
  const Traits plane{.roughness = 0.9,
                     .curvature = 0.01,
                     .contact = 0.3,
                     .explained = 0,
                     .area = 0.2,
                     .density = 1,
                     .fill = 0.6};
  const auto with = [&](auto change) {
    Traits traits = plane;
    change(traits);
    return log_odds(traits);
  };
  const double odds = log_odds(plane);
  CHECK(odds > 0);
  CHECK(with([](Traits& t) { t.roughness = 1.4; }) < odds);
  CHECK(with([](Traits& t) { t.curvature = 0.4; }) < odds);
  CHECK(with([](Traits& t) { t.contact = 0.9; }) < odds);
  CHECK(with([](Traits& t) { t.explained = 0.5; }) < odds);
  CHECK(with([](Traits& t) { t.area = 0.05; }) < odds);
  CHECK(with([](Traits& t) { t.fill = 0.3; }) < odds);
  // Far out of what was seen they say no more than at its limits.
  CHECK(with([](Traits& t) { t.roughness = 9; }) == with([](Traits& t) { t.roughness = 2; }));
  CHECK(std::isfinite(with([](Traits& t) { t.area = t.density = 0; })));
}

TEST_CASE("amid clutter more is asked of each small cluster") {
  // Plates over each other: some far rougher than noise, the others from smooth to a bit rough.
  const auto kept = [](int clutter, double prior_share) {
    PointCloud cloud;
    Random random(6);
    for (int k = 0; k < 60; ++k) {
      const double roughness = k < clutter ? 3 : 1 + 0.1 * (k % 15);
      add_rectangle(cloud, {0, 0, 0.5 * k}, {0.3, 0, 0}, {0, 0.3, 0}, 0.015, 0.004 * roughness,
                    random);
    }
    const Stages s = run_stages(std::move(cloud), known_scale(0.004, 0.015));
    const auto plate = [](const Vec3& p) {
      return static_cast<std::int32_t>(std::lround(p.z() / 0.5));
    };
    const Clustering c = weigh_evidence(s.grid, s.neighbors, s.scale, label_sites(s.grid, plate),
                                        {.prior_share = prior_share});
    std::set<std::int32_t> labels(c.label.begin(), c.label.end());
    labels.erase(kNone);
    return labels;
  };
  const auto alone = kept(45, 0), weighed = kept(45, 1);
  CHECK(weighed.size() < alone.size());
  CHECK(weighed.size() > 2);
  CHECK(*weighed.begin() >= 45);
  CHECK(kept(0, 1).size() > kept(0, 0).size());
}

TEST_CASE("sites that are dropped are awake, the others as before") {
  const Stages s = plate(0.4, 0.4, 0.02, 0.004);
  Clustering start = label_sites(s.grid, [](const Vec3&) { return 0; });
  std::fill(start.awake.begin(), start.awake.end(), 0);
  const Clustering kept = weigh_evidence(s.grid, s.neighbors, s.scale, start);
  CHECK(kept.awake == start.awake);
  const Clustering gone = weigh_evidence(s.grid, s.neighbors, s.scale, start, {.min_points = 1e6});
  CHECK(std::count(gone.awake.begin(), gone.awake.end(), 0) == 0);
}
