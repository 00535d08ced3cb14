// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/regularise.h"

#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

const Scale kScale{.noise = kNoise, .spacing = 0.03, .voxel = 0.05};

// A cluster of points of a rectangle from `corner` along a and b.
rival::Cluster rectangle(const Vec3& corner, const Vec3& a, const Vec3& b, Random& random,
                         double spacing = 0.03) {
  PointCloud cloud;
  add_rectangle(cloud, corner, a, b, spacing, kNoise, random);
  rival::Cluster cluster;
  for (const Vec3f& p : cloud.points) cluster.moments += Vec3(p.cast<double>());
  cluster.fit = fit(cluster.moments);
  return cluster;
}

const Vec3 kX = 4 * Vec3::UnitX(), kY = 3 * Vec3::UnitY(), kZ = 2.5 * Vec3::UnitZ();

std::vector<rival::Cluster> turned(const std::vector<rival::Cluster>& clusters,
                                   const RegulariseOptions& options = {}) {
  return regularise(kScale, {.clusters = clusters}, options).clusters;
}

double cosine(const rival::Cluster& a, const rival::Cluster& b) {
  return std::abs(a.fit.plane.normal.dot(b.fit.plane.normal));
}

// Every plane is as near to its points as chance would have it, and faces where it did.
void check_near(const std::vector<rival::Cluster>& before,
                const std::vector<rival::Cluster>& after) {
  REQUIRE(after.size() == before.size());
  for (std::size_t k = 0; k < after.size(); ++k) {
    const rival::Cluster &a = before[k], &b = after[k];
    CHECK(b.moments.n == a.moments.n);
    CHECK(b.fit.centroid == a.fit.centroid);
    CHECK(b.fit.plane.normal.norm() == doctest::Approx(1).scale(0).epsilon(1e-12));
    CHECK(b.fit.plane.normal.dot(a.fit.plane.normal) > std::cos(0.02));
    const double square = b.moments.mean_square(b.fit.plane);
    CHECK(square == doctest::Approx(b.fit.variance[0]).scale(0).epsilon(1e-6));
    CHECK((square - a.fit.variance[0]) * a.moments.n < 25 * kNoise * kNoise);
  }
}

}  // namespace

TEST_CASE("the faces of a room become parallel and square") {
  std::size_t exact_pairs = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const std::vector<rival::Cluster> before = {
        rectangle(Vec3::Zero(), kX, kY, random), rectangle(kZ, kX, kY, random),
        rectangle(Vec3::Zero(), kX, kZ, random), rectangle(kY, kX, kZ, random),
        rectangle(Vec3::Zero(), kY, kZ, random), rectangle(kX, kY, kZ, random)};
    const std::vector<rival::Cluster> after = turned(before);
    check_near(before, after);
    std::size_t square = 0;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const double c = cosine(after[i], after[k]), exact = i / 2 == k / 2 ? 1 : 0;
        square += std::abs(c - exact) < 1e-9;
        CHECK(std::abs(c - exact) < 0.002);
      }
    exact_pairs += square;
  }
  CHECK(exact_pairs > 0.75 * 20 * 15);  // chance lets a face object now and then
}

TEST_CASE("a wall that its points tell is askew stays so") {
  Random random(1);
  for (double angle : {0.01, 0.03, 0.3}) {
    const Vec3 askew = Eigen::AngleAxisd(angle, Vec3::UnitX()) * kY;
    const std::vector<rival::Cluster> before = {rectangle(Vec3::Zero(), kX, kY, random),
                                                rectangle(kZ, kX, askew, random)};
    const std::vector<rival::Cluster> after = turned(before);
    check_near(before, after);
    CHECK(std::acos(cosine(after[0], after[1])) == doctest::Approx(angle).scale(0).epsilon(0.1));
  }
}

TEST_CASE("pieces of one plane come into one, those on another level do not") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const Vec3 right = 5 * Vec3::UnitX(), step(10, 0, 0.005);
    const std::vector<rival::Cluster> before = {rectangle(Vec3::Zero(), kX, kY, random),
                                                rectangle(right, kX, kY, random),
                                                rectangle(step, kX, kY, random)};
    const std::vector<rival::Cluster> after = turned(before);
    check_near(before, after);
    const auto apart = [&](std::size_t i, std::size_t k) {
      return std::abs(after[i].fit.plane.signed_distance(after[k].fit.plane.project(kX)));
    };
    CHECK(apart(0, 1) < (cosine(after[0], after[1]) > 1 - 1e-12 ? 1e-9 : 0.002));
    CHECK(apart(0, 2) > 0.003);
  }
}

TEST_CASE("labels stay, nothing is nothing, and no angle turns no plane") {
  Random random(3);
  Clustering c{
      .label = {0, 1, kNone, 0},
      .clusters = {rectangle(Vec3::Zero(), kX, kY, random), rectangle(kZ, kX, kY, random)}};
  CHECK(regularise(kScale, c).label == c.label);
  CHECK(regularise(kScale, {}).clusters.empty());
  CHECK(cosine(c.clusters[0], c.clusters[1]) < 1 - 1e-12);
  CHECK(cosine(turned(c.clusters)[0], turned(c.clusters)[1]) > 1 - 1e-12);
  const std::vector<rival::Cluster> same = turned(c.clusters, {.max_angle = 0});
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK((same[k].fit.plane.normal - c.clusters[k].fit.plane.normal).norm() < 1e-6);
    CHECK(std::abs(same[k].fit.plane.offset - c.clusters[k].fit.plane.offset) < 1e-6);
  }
}

TEST_CASE("a small part of a wall that is hardly off the large one is in its plane") {
  Random random(5);
  const rival::Cluster wall = rectangle({0, 0, 0}, kX, kZ, random);
  for (double off : {0.002, 0.004, 0.012}) {
    const rival::Cluster above =
        rectangle({1, off, 2.5}, Vec3(1, 0, 0), Vec3(0, 0.001, 0.4), random);
    const auto after = turned({wall, above});
    check_near({wall}, {after[0]});
    const bool is_one = std::abs(after[1].fit.plane.signed_distance(wall.fit.centroid)) < 0.001;
    CHECK(is_one == (off < 0.01));
  }
  // What is far away keeps its own plane, if its points tell it well enough.
  const rival::Cluster far = rectangle({9, 0.004, 0}, kX, kZ, random, 0.01);
  const auto after = turned({wall, far});
  CHECK(std::abs(after[1].fit.plane.signed_distance({11, 0.004, 1})) < 0.001);
}

TEST_CASE("a plane is turned as far as the scan's surfaces bend, but no farther") {
  Random random(3);
  const Vec3 off = kX + 0.006 * Vec3::UnitZ();  // by 1.5 mrad, as a floor is that sags
  const std::vector<rival::Cluster> before = {rectangle(Vec3::Zero(), kX, kY, random),
                                              rectangle(kZ, off, kY, random)};
  const auto turned_by = [&](double bend) {
    Scale scale = kScale;
    if (bend > 0) scale.flatness.samples = {{4, bend}};
    const auto after = regularise(scale, {.clusters = before}, {}).clusters;
    return 1 - cosine(after[0], after[1]) < 1e-12;
  };
  CHECK_FALSE(turned_by(0));
  CHECK_FALSE(turned_by(0.0002));
  CHECK(turned_by(0.004));
}
