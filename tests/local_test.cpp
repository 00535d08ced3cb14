// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/local.h"

#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

// Fits to points with this covariance alone; planar whatever their noise.
LocalPlane fit_to(const Mat3& covariance, std::uint32_t points) {
  Grid grid;
  Site site;
  const Mat3& c = covariance;
  const double values[6] = {c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)};
  for (std::size_t k = 0; k < 6; ++k) site.covariance[k] = static_cast<float>(values[k]);
  site.points = points;
  site.mean = Vec3f(100, 200, -300);
  grid.sites = {site};
  Neighbors neighbors;
  neighbors.parts = {{{0, 1}, {0}}};
  return fit_locally(grid, neighbors, {.noise = 1},
                     {.max_noise = 1e9, .min_extent = 0, .min_ratio = 0})[0];
}

Mat3 any_rotation(Random& random) {
  return Eigen::AngleAxisd(random.uniform(0, 3), random.direction()).toRotationMatrix();
}

double cosine(const LocalPlane& plane, const Vec3& normal) {
  return std::abs(plane.normal.cast<double>().dot(normal));
}

// Two walls and a floor that meet in the origin.
PointCloud corner_points(double noise) {
  PointCloud cloud;
  Random random(1);
  const Vec3 o = Vec3::Zero(), x = 2 * Vec3::UnitX(), y = 2 * Vec3::UnitY(), z = 2 * Vec3::UnitZ();
  add_rectangle(cloud, o, x, y, 0.015, noise, random);
  add_rectangle(cloud, o, y, z, 0.015, noise, random);
  add_rectangle(cloud, o, z, x, 0.015, noise, random);
  return cloud;
}

}  // namespace

TEST_CASE("the fast fit finds the eigenvalues and the normal that Eigen finds") {
  Random random(1);
  int distinct = 0;
  for (int round = 0; round < 20000; ++round) {
    // From a flat sheet to a needle and a ball, some of them exactly so.
    const double size = std::pow(10, random.uniform(-5, 1));
    Vec3 values(random.uniform(1e-4, 1), random.uniform(1e-4, 1), 1);
    if (round % 5 == 0) values.x() = values.y();
    if (round % 7 == 0) values.y() = 1;
    if (round % 3 == 0) values.x() *= 0.001;
    const Mat3 axes = any_rotation(random);
    // As floats, which is what the fit is given.
    const Mat3 c =
        (axes * (size * values).asDiagonal() * axes.transpose()).cast<float>().cast<double>();
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(c);
    const Vec3 expected = eigen.eigenvalues();
    const double largest = expected[2], least = std::max(expected[0], 0.0);
    const LocalPlane found = fit_to(c, 1000);
    CHECK(found.normal.norm() == doctest::Approx(1).scale(0).epsilon(1e-4));
    // What rounding may do to the root of a polynomial in float.
    const double rounding = 1e-6 * largest * largest / expected[1];
    const double square = std::pow(found.rank / (1 + 2 / std::sqrt(1000.0)), 2) * 0.997;
    const bool is_double = expected[1] < 1.5 * least;
    if (is_double) {
      CHECK(found.ratio < 2);  // that is, not planar; its normal means nothing
      continue;
    }
    ++distinct;
    CHECK(std::abs(square - least) < rounding + 1e-4 * least);
    CHECK(std::abs(1 / found.ratio - least / expected[1]) <
          rounding / expected[1] + 1e-3 * least / expected[1]);
    CHECK(eigen.eigenvectors().col(0).cross(found.normal.cast<double>()).norm() <
          4 * rounding / (expected[1] - least));
  }
  CHECK(distinct > 10000);
}

TEST_CASE("what is exactly flat fits exactly, and what has no extent is not planar") {
  Random random(2);
  for (int round = 0; round < 200; ++round) {
    const Vec3 normal = random.direction();
    const LocalPlane flat = fit_to(Mat3::Identity() - normal * normal.transpose(), 100);
    CHECK(flat.planar());
    CHECK(flat.rank < 1e-3);
    CHECK(cosine(flat, normal) > 1 - 1e-5);
  }
  CHECK_FALSE(fit_to(Mat3::Zero(), 100).planar());
  CHECK(fit_to(Vec3(1, 1, 0).asDiagonal(), 4).planar());
  CHECK_FALSE(fit_to(Vec3(1, 1, 0).asDiagonal(), 3).planar());
}

TEST_CASE(
    "sites of a plane at any tilt are planar and have its normal, as far as noise lets them") {
  Random random(3);
  for (double noise : {0.0, 0.003, 0.01})
    for (int round = 0; round < 5; ++round) {
      const Vec3 normal = random.direction();
      const PlaneFrame frame = frame_of({normal, random.uniform(-3, 3)});
      PointCloud cloud;
      add_rectangle(cloud, frame.origin, 2 * frame.u, 2 * frame.v, 0.015, noise, random);
      const Stages s = run_stages(cloud, known_scale(std::max(noise, 0.0005), 0.015));
      std::size_t planar = 0, right = 0;
      for (const LocalPlane& plane : s.local) {
        planar += plane.planar();
        right += cosine(plane, normal) > std::cos(noise > 0.005 ? 0.35 : 0.1);
        if (noise == 0) CHECK(cosine(plane, normal) > 1 - 1e-4);
      }
      CHECK(static_cast<double>(planar) > 0.95 * static_cast<double>(s.local.size()));
      CHECK(static_cast<double>(right) > 0.95 * static_cast<double>(s.local.size()));
    }
}

TEST_CASE("edges and corners are not planar, and the faces between them are") {
  for (double noise : {0.001, 0.003}) {
    const Stages s = run_stages(corner_points(noise), known_scale(noise, 0.015));
    std::size_t edges = 0, faces = 0;
    for (std::size_t i = 0; i < s.local.size(); ++i) {
      Vec3 p = s.grid.sites[i].position();
      std::sort(p.begin(), p.end());
      if (p.y() < 0.03) {
        ++edges;
        CHECK_FALSE(s.local[i].planar());
      } else if (p.y() > 0.1) {
        ++faces;
        CHECK(s.local[i].planar());
      }
    }
    CHECK(edges > 100);
    CHECK(faces > 5000);
  }
}

TEST_CASE("sites without neighbours, and those that a mask leaves out, keep their planes") {
  const Stages s = run_stages(corner_points(0.003), known_scale(0.003, 0.015));
  std::vector<LocalPlane> old(s.grid.sites.size());
  for (LocalPlane& plane : old) plane.ratio = -7;
  std::vector<std::uint8_t> only(s.grid.sites.size());
  for (std::size_t i = 0; i < only.size(); ++i) only[i] = i % 3 == 0;
  const auto masked = fit_locally(s.grid, s.neighbors, s.scale, {}, old, only);
  const auto alone = fit_locally(s.grid, find_neighbors(s.grid, {}, only), s.scale, {}, old);
  const auto all = fit_locally(s.grid, s.neighbors, s.scale);
  for (std::size_t i = 0; i < only.size(); ++i) {
    CHECK((masked[i].ratio == -7) == !only[i]);
    CHECK((alone[i].ratio == -7) == !only[i]);
    if (only[i]) CHECK(masked[i].normal == all[i].normal);
  }
}
