// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/grid.h"

#include <algorithm>
#include <set>

#include "parallel.h"
#include "report.h"
#include "support/scenes.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

constexpr double kVoxel = 0.0625;  // a power of two, so that the voxel of a point is exact

using Voxel = std::array<int, 3>;

Voxel voxel_of(const Vec3f& p) {
  const Eigen::Array3d at = (p.cast<double>() / kVoxel).array().floor();
  return {static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z())};
}

Voxel voxel_of(const PointCloud& cloud, const Grid& grid, std::size_t site) {
  return voxel_of(cloud.points[grid.points_of(site)[0]]);
}

PointCloud random_points(Random& random, int count, const Vec3& at = Vec3::Zero(),
                         double reach = 1.5) {
  PointCloud cloud;
  for (int i = 0; i < count; ++i)
    cloud.points.push_back((at + Vec3(random.uniform(-reach, reach), random.uniform(-reach, reach),
                                      random.uniform(-reach, reach)))
                               .cast<float>());
  return cloud;
}

// Each point is in the site of its voxel and in no other.
void check_sites(const PointCloud& cloud, const Grid& grid) {
  std::vector<int> times(cloud.points.size());
  std::set<Voxel> voxels;
  for (std::size_t i = 0; i < grid.sites.size(); ++i) {
    REQUIRE(grid.sites[i].points > 0);
    const Voxel voxel = voxel_of(cloud, grid, i);
    CHECK(voxels.insert(voxel).second);
    const std::uint32_t v = grid.sites[i].voxel;
    CHECK(Voxel{static_cast<int>(v & 7), static_cast<int>(v >> 3 & 7),
                static_cast<int>(v >> 6 & 7)} == Voxel{voxel[0] & 7, voxel[1] & 7, voxel[2] & 7});
    for (std::uint32_t p : grid.points_of(i)) {
      ++times[p];
      CHECK(voxel_of(cloud.points[p]) == voxel);
    }
  }
  CHECK(std::all_of(times.begin(), times.end(), [](int t) { return t == 1; }));
}

bool same_site(const Site& a, const Site& b) {
  return a.mean == b.mean && a.covariance == b.covariance && a.points == b.points &&
         a.first == b.first && a.voxel == b.voxel;
}

}  // namespace

TEST_CASE("every point is in one site, that of its voxel, wherever the scan is") {
  Random random(1);
  for (const Vec3& at : {Vec3(0, 0, 0), Vec3(5000, -7000, 300), Vec3(-16000, 0.5, 7)}) {
    const PointCloud cloud = random_points(random, 6000, at);
    const Grid grid = build_grid(cloud, kVoxel);
    CHECK(grid.voxel == kVoxel);
    check_sites(cloud, grid);
  }
}

TEST_CASE("a site's moments are those of its points, to a 4096th of a voxel") {
  Random random(2);
  PointCloud cloud = random_points(random, 20000, {0, 0, 0}, 0.5);
  add_rectangle(cloud, {-1, -1, 0.3}, {2, 0, 0}, {0, 2, 0.1}, 0.01, 0.002, random);
  const Grid grid = build_grid(cloud, kVoxel);
  const double unit = kVoxel / 4096;
  for (std::size_t i = 0; i < grid.sites.size(); ++i) {
    const Site& site = grid.sites[i];
    Moments direct;  // about the site's mean, where little is lost to rounding
    for (std::uint32_t p : grid.points_of(i))
      direct += Vec3(cloud.points[p].cast<double>() - site.position());
    CHECK(direct.n == site.points);
    CHECK(direct.mean().cwiseAbs().maxCoeff() < unit);
    const auto& c = site.covariance;
    Mat3 covariance;
    covariance << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
    CHECK((covariance - direct.covariance()).cwiseAbs().maxCoeff() < kVoxel * unit);
    const Vec3 v = Vec3(1, 2, 3).normalized();
    CHECK(std::abs(site.variance(v) - v.dot(covariance * v)) < 1e-9);
    CHECK(site.moments().n == direct.n);
    CHECK((site.moments().mean() - site.position()).norm() < 1e-12);
    CHECK((site.moments().covariance() - covariance).norm() < 1e-9);
  }
}

TEST_CASE(
    "sites near another are those within so many voxels, across blocks, inner ones left out") {
  Random random(3);
  PointCloud cloud = random_points(random, 2500, {0, 0, 0}, 0.8);
  const Grid grid = build_grid(cloud, kVoxel);
  REQUIRE(grid.blocks.size() > 27);
  std::vector<Voxel> voxels;
  for (std::size_t i = 0; i < grid.sites.size(); ++i) voxels.push_back(voxel_of(cloud, grid, i));
  const auto apart = [&](std::size_t i, std::size_t k) {
    int most = 0;
    for (std::size_t a = 0; a < 3; ++a)
      most = std::max(most, std::abs(voxels[i][a] - voxels[k][a]));
    return most;
  };
  for (int query = 0; query < 60; ++query) {
    const std::size_t site = random.next() % grid.sites.size();
    for (int reach = 1; reach <= 8; ++reach)
      for (int inner : {-1, 0, 1, reach - 1, reach}) {
        std::vector<std::uint32_t> found, expected;
        grid.for_each_near(
            site, reach, [&](std::uint32_t k) { found.push_back(k); }, inner);
        for (std::uint32_t k = 0; k < grid.sites.size(); ++k)
          if (const int d = apart(site, k); d <= reach && d > inner) expected.push_back(k);
        std::sort(found.begin(), found.end());
        CHECK(found == expected);
      }
  }
}

TEST_CASE("the mask of a square has the bits that are near, for any place and reach") {
  for (int x = -8; x < 16; ++x)
    for (int y = -8; y < 16; ++y)
      for (int reach = 0; reach <= 8; ++reach) {
        std::uint64_t expected = 0;
        for (int bit = 0; bit < 64; ++bit)
          if (std::abs(bit % 8 - x) <= reach && std::abs(bit / 8 - y) <= reach)
            expected |= std::uint64_t{1} << bit;
        CHECK(square_mask(x, y, reach) == expected);
      }
}

TEST_CASE("sites do not depend on the order of the points or the number of threads") {
  Random random(4);
  PointCloud cloud = random_points(random, 150000);
  const Grid before = build_grid(cloud, kVoxel);
  for (int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    shuffle(cloud.points, random);
    const Grid grid = build_grid(cloud, kVoxel);
    CHECK(std::equal(grid.sites.begin(), grid.sites.end(), before.sites.begin(), before.sites.end(),
                     same_site));
    CHECK(grid.blocks.size() == before.blocks.size());
  }
}

TEST_CASE("a scan moved by whole blocks has the same sites, moved") {
  Random random(5);
  PointCloud cloud;
  for (int i = 0; i < 3000; ++i)  // on a grid of a millimetre, so that moving them is exact
    cloud.points.push_back(
        Vec3(random.whole(-999, 999), random.whole(-999, 999), random.whole(-999, 999))
            .cast<float>() /
        1024);
  const Grid before = build_grid(cloud, kVoxel);
  const Vec3f move(4096, -2048, 512.5);
  for (Vec3f& p : cloud.points) p += move;
  const Grid after = build_grid(cloud, kVoxel);
  REQUIRE(after.sites.size() == before.sites.size());
  for (std::size_t i = 0; i < after.sites.size(); ++i) {
    CHECK((after.sites[i].mean - move - before.sites[i].mean).norm() < 0.001);
    CHECK(after.sites[i].covariance == before.sites[i].covariance);
    CHECK(after.sites[i].points == before.sites[i].points);
    CHECK(after.sites[i].voxel == before.sites[i].voxel);
  }
}

TEST_CASE("a few points far from all others, and points too far away, are in no site") {
  Random random(6);
  PointCloud cloud = random_points(random, 5000);
  const Grid before = build_grid(cloud, kVoxel);
  const auto check_same = [&] {
    const Grid grid = build_grid(cloud, kVoxel);
    REQUIRE(grid.sites.size() == before.sites.size());
    for (std::size_t i = 0; i < grid.sites.size(); ++i) {
      CHECK(grid.sites[i].mean == before.sites[i].mean);
      CHECK(grid.points_of(i).size() == before.points_of(i).size());
    }
  };
  for (int i = 0; i < 11; ++i) cloud.points.emplace_back(100.f, 100.f, 100.f);
  cloud.points.emplace_back(-1000.f, 0.f, 0.f);
  for (float far : {-4e4f, 1e6f, -1e30f, 3e38f}) cloud.points.emplace_back(0.f, far, 0.f);
  check_same();
  cloud.points.emplace_back(100.f, 100.f, 100.f);
  CHECK(build_grid(cloud, kVoxel).sites.size() == before.sites.size() + 1);
  cloud.points.emplace_back(300.01f, 0.f, 0.f);
  cloud.points.emplace_back(299.99f, 0.f, 0.f);  // in the next block
  CHECK(build_grid(cloud, kVoxel).sites.size() == before.sites.size() + 3);
}

TEST_CASE("nothing and one point make no site; a million equal points one") {
  CHECK(build_grid({}, kVoxel).sites.empty());
  CHECK(build_grid(cloud_of({{1, 2, 3}}), kVoxel).sites.empty());
  const PointCloud cloud = cloud_of(std::vector<Vec3>(1000000, Vec3(-1, 2, 0.3)));
  const Grid grid = build_grid(cloud, kVoxel);
  REQUIRE(grid.sites.size() == 1);
  CHECK(grid.sites[0].points == 1000000);
  CHECK((grid.sites[0].position() - Vec3(-1, 2, 0.3)).norm() < kVoxel / 4096);
  for (float c : grid.sites[0].covariance) CHECK(c == 0);
}

TEST_CASE("a parted site has the points of one side, a new one in its voxel those of the other") {
  Random random(7);
  const PointCloud cloud = random_points(random, 20000, {0, 0, 0}, 0.5);
  const Grid before = build_grid(cloud, kVoxel);
  Grid grid = before;
  for (std::uint32_t i = 0; i < before.sites.size(); i += 3)
    part_site(cloud, i, plane_through(before.sites[i].position(), random.direction()), grid);
  CHECK(grid.sites.size() > before.sites.size());
  REQUIRE(grid.twin.size() == grid.sites.size());
  REQUIRE(grid.separator.size() == grid.sites.size());
  for (std::uint32_t i = 0; i < before.sites.size(); ++i) {
    CHECK((grid.separator[i] >= 0) == (i % 3 == 0));
    if (grid.twin[i] < 0) {
      CHECK(same_site(grid.sites[i], before.sites[i]));
      continue;
    }
    const auto twin = static_cast<std::size_t>(grid.twin[i]);
    REQUIRE(twin >= before.sites.size());
    CHECK(grid.separator[twin] == grid.separator[i]);
    CHECK(grid.sites[twin].voxel == grid.sites[i].voxel);
    CHECK(grid.sites[i].points >= grid.sites[twin].points);
    CHECK(grid.sites[i].points + grid.sites[twin].points == before.sites[i].points);
    const Plane& plane = grid.separators[static_cast<std::size_t>(grid.separator[i])];
    const bool side = plane.signed_distance(grid.sites[i].position()) > 0;
    for (std::uint32_t p : grid.points_of(i))
      CHECK((plane.signed_distance(cloud.points[p].cast<double>()) > 0) == side);
    for (std::uint32_t p : grid.points_of(twin))
      CHECK((plane.signed_distance(cloud.points[p].cast<double>()) > 0) != side);
    const Moments sum = grid.sites[i].moments() + grid.sites[twin].moments();
    CHECK((sum.mean() - before.sites[i].position()).norm() < 1e-6);
    CHECK((sum.covariance() - before.sites[i].moments().covariance()).norm() < 1e-6);
    int times = 0;
    grid.for_each_near(i, 1, [&](std::uint32_t k) { times += k == i || k == twin; });
    CHECK(times == 2);
  }
}

TEST_CASE("a site with all its points on one side is noted as such, and stays") {
  Random random(8);
  const PointCloud cloud = random_points(random, 2000, {0, 0, 0}, 0.2);
  const Grid before = build_grid(cloud, kVoxel);
  Grid grid = before;
  part_site(cloud, 5, {Vec3::UnitX(), 3}, grid);
  CHECK(grid.sites.size() == before.sites.size());
  CHECK(same_site(grid.sites[5], before.sites[5]));
  CHECK(grid.separator[5] == 0);
  CHECK(grid.twin[5] == -1);
}
