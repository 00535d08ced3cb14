// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The default method as a whole, through `reconstruct`, and its stages on next to nothing.
#include "rival/rival.h"

#include <cstdio>
#include <numbers>
#include <numeric>

#include "parallel.h"
#include "reconstruct.h"
#include "scan/read_scan.h"
#include "scan/write_scan.h"
#include "support/stages.h"
#include "world/validate.h"
#include "world/virtual_scan.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

PointCloud room_scan() {
  return virtual_scan(read_world(in_project("worlds/room.json")),
                      {.points = 60000, .outliers = 0.01, .mixed = 0.3})
      .cloud;
}

// The areas of a world's surfaces, ascending.
std::vector<double> areas(const World& world) {
  std::vector<double> result;
  for (const Surface& s : world.surfaces) result.push_back(area(world, s));
  std::sort(result.begin(), result.end());
  return result;
}

void check_room_areas(const World& world, const Vec3& size, double share) {
  CHECK(validate(world).empty());
  REQUIRE(world.surfaces.size() == 6);
  std::vector<double> expected;
  for (double a : {size.x() * size.y(), size.y() * size.z(), size.z() * size.x()})
    expected.insert(expected.end(), 2, a);
  std::sort(expected.begin(), expected.end());
  const std::vector<double> found = areas(world);
  for (std::size_t i = 0; i < 6; ++i)
    CHECK(found[i] == doctest::Approx(expected[i]).scale(0).epsilon(share));
}

// Writes the points, moved, as text with a tenth of a millimetre.
std::filesystem::path write_text(const std::filesystem::path& path, const PointCloud& cloud,
                                 const Vec3& move) {
  std::string text;
  for (const Vec3f& p : cloud.points) {
    const Vec3 at = p.cast<double>() + move;
    char line[100];
    std::snprintf(line, sizeof line, "%.4f %.4f %.4f\n", at.x(), at.y(), at.z());
    text += line;
  }
  return write_file(path, text);
}

// Runs all stages and looks at what each makes of it. Gives the number of planes.
std::size_t run_all(Stages s) {
  Clustering c = s.grow();
  check_clustering(s.grid, c);
  c = compete(s.grid, s.neighbors, s.scale, s.local, c);
  check_clustering(s.grid, c);
  c = merge_clusters(s.grid, s.neighbors, s.scale, c);
  check_clustering(s.grid, c);
  c = settle(s.grid, s.neighbors, s.scale, s.local, c);
  check_clustering(s.grid, c);
  c = split_clusters(s.grid, s.neighbors, c);
  check_clustering(s.grid, c);
  c = bridge_clusters(s.grid, s.scale, c);
  check_clustering(s.grid, c);
  c = part(s.grid, s.neighbors, s.scale, s.local, c);
  check_clustering(s.grid, c);
  c = confirm(s.grid, s.neighbors, s.scale, s.local, c);
  check_clustering(s.grid, c);
  const std::size_t clusters = c.clusters.size();
  c = regularise(s.scale, c);  // which moves planes, but no sites
  CHECK(c.clusters.size() == clusters);
  const LabelledPoints labelled = label_points(s.cloud, s.grid, s.neighbors, s.scale, c);
  CHECK(labelled.labels.size() == s.cloud.points.size());
  return labelled.planes.size();
}

}  // namespace

TEST_CASE(
    "what has grown in a room settles in six clusters and crumbs, of which evidence rids it") {
  for (double noise : {0.003, 0.005, 0.01, 0.02})
    for (std::uint64_t seed : {1u, 2u}) {
      const Stages s = run_stages(room_points({4, 3, 2.5}, 0.03, noise, seed));
      CHECK(s.grow().clusters.size() >= 6);
      std::vector<double> points;
      double all = 0;
      for (const rival::Cluster& k : s.settle().clusters)
        points.push_back(k.moments.n), all += points.back();
      std::sort(points.rbegin(), points.rend());
      REQUIRE(points.size() >= 6);
      CHECK(points[5] > 0.9 * 3 * 2.5 / (0.03 * 0.03));
      CHECK(std::accumulate(points.begin() + 6, points.end(), 0.0) < 0.01 * all);
      CHECK(s.confirm().clusters.size() == 6);
      if (seed == 1) CHECK(run_all(s) == 6);
    }
  const Stages cluttered = run_stages(room_scan());
  CHECK(run_all(cluttered) >= 6);
}

TEST_CASE("no stage minds an empty scan, a single site, or a scan without planes") {
  CHECK(run_all(run_stages({})) == 0);
  const Stages single = run_stages(cloud_of(std::vector<Vec3>(100, Vec3(1, 2, 3))));
  CHECK(single.grid.sites.size() == 1);
  CHECK(run_all(single) == 0);
  Random random(1);
  PointCloud cloud;
  for (int i = 0; i < 5000; ++i)
    cloud.points.push_back(
        Vec3(random.uniform(), random.uniform(), random.uniform()).cast<float>());
  const Stages noise = run_stages(cloud, known_scale(0.002, 0.05));
  CHECK(noise.grid.sites.size() > 1000);
  CHECK(run_all(noise) == 0);
}

TEST_CASE("all sites in no cluster are found again by birth, or stay there without it") {
  const Stages s = run_stages(room_points({4, 3, 2.5}, 0.03, 0.005));
  const Clustering nothing = label_sites(s.grid, [](const Vec3&) { return kNone; });
  for (int rounds : {0, 1}) {
    std::vector<LocalPlane> local = s.local;
    const Clustering c =
        settle(s.grid, s.neighbors, s.scale, local, nothing, {.birth_rounds = rounds});
    check_clustering(s.grid, c);
    CHECK(confirm(s.grid, s.neighbors, s.scale, s.local, c).clusters.size() ==
          (rounds == 0 ? 0 : 6));
  }
}

TEST_CASE("the world's text is the same for any threads, order, files and strays") {
  PointCloud cloud = room_scan();
  cloud.viewpoints.clear();  // which a file does not hold
  const std::string before = world_text(reconstruct(cloud).world);
  for (int threads : {1, 2, 3, 4}) {
    const ThreadLimit limit(threads);
    CHECK(world_text(reconstruct(cloud).world) == before);
  }
  shuffle_points(cloud, 1);
  CHECK(world_text(reconstruct(cloud).world) == before);

  const TempFolder folder;
  std::vector<std::filesystem::path> files;
  for (std::size_t k = 0; k < 3; ++k) {
    PointCloud part;
    for (std::size_t i = k; i < cloud.points.size(); i += 3) part.points.push_back(cloud.points[i]);
    files.push_back(folder / ("part" + std::to_string(k) + ".ply"));
    write_scan(files.back(), part);
  }
  CHECK(world_text(reconstruct(read_scan(files)).world) == before);
  std::swap(files[0], files[2]);
  CHECK(world_text(reconstruct(read_scan(files)).world) == before);

  cloud.points.emplace_back(0.f, 3000.f, -1.f);
  CHECK(world_text(reconstruct(cloud).world) == before);
}

TEST_CASE("with points that know their viewpoint the text is the same for any order and files") {
  PointCloud cloud = room_points({4, 3, 2.5}, 0.03, 0.005);
  cloud.viewpoints = {{1, 1, 1.5}, {3, 2, 1.5}, {2, 5, 1.5}};
  Random random(6);
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    cloud.viewers.push_back(random.whole(-1, 1));
  const std::string before = world_text(reconstruct(cloud).world);
  shuffle_points(cloud, 1);
  for (int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    CHECK(world_text(reconstruct(cloud).world) == before);
  }
  const TempFolder folder;
  std::vector<std::filesystem::path> files;
  for (std::size_t k = 0; k < 2; ++k) {
    PointCloud part;
    for (std::size_t i = k; i < cloud.points.size(); i += 2) {
      part.points.push_back(cloud.points[i]);
      part.viewers.push_back(cloud.viewers[i]);
    }
    files.push_back(folder / ("part" + std::to_string(k) + ".ply"));
    write_scan(files.back(), part);
  }
  CHECK(world_text(reconstruct(read_scan(files, cloud.viewpoints)).world) == before);
  std::swap(files[0], files[1]);
  CHECK(world_text(reconstruct(read_scan(files, cloud.viewpoints)).world) == before);
}

TEST_CASE("coordinates of thousands of kilometres give the same room there") {
  const PointCloud cloud = room_points({5, 4, 2.7}, 0.04, 0.005);
  const TempFolder folder;
  const Vec3 move(565123.25, 5.5e6, 431.5);
  const World near =
      reconstruct(read_scan({write_text(folder / "near.xyz", cloud, {0, 0, 0})})).world;
  const World far = reconstruct(read_scan({write_text(folder / "far.xyz", cloud, move)})).world;
  check_room_areas(near, {5, 4, 2.7}, 0.01);
  check_room_areas(far, {5, 4, 2.7}, 0.01);
  const Box3 a = bounds(near), b = bounds(far);
  CHECK((a.min() + near.frame.origin + move - b.min() - far.frame.origin).norm() < 0.003);
  CHECK((a.max() + near.frame.origin + move - b.max() - far.frame.origin).norm() < 0.003);
}

TEST_CASE("a tilted room has its six surfaces, of the right size") {
  const Vec3 size(5, 4, 2.7);
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(1, 2, 3)}) {
    PointCloud cloud = room_points(size, 0.03, 0.005);
    const Mat3 turn =
        Eigen::AngleAxisd(20 * std::numbers::pi / 180, axis.normalized()).toRotationMatrix();
    for (Vec3f& p : cloud.points) p = (turn * p.cast<double>()).cast<float>();
    check_room_areas(reconstruct(cloud).world, size, 0.02);
  }
}

TEST_CASE("a room scanned in centimetres has its six surfaces, and is warned of") {
  PointCloud cloud = room_points({5, 4, 2.7}, 0.04, 0.01);
  CHECK(reconstruct(cloud).report.warnings.empty());
  for (Vec3f& p : cloud.points) p *= 100;
  const ReconstructResult result = reconstruct(cloud);
  check_room_areas(result.world, {500, 400, 270}, 0.02);
  REQUIRE(result.report.warnings.size() == 1);
  CHECK(contains(result.report.warnings[0], "metres"));
}

TEST_CASE("a depth camera's image gives its three surfaces with the preset for it") {
  PointCloud cloud;
  Random random(3);
  // In the camera's frame: the floor 1.1 m below it, a wall 3.5 m ahead, one 1.4 m to the left.
  for (int i = 0; i < 240; ++i)
    for (int k = 0; k < 320; ++k) {
      const Vec3 ray((k - 159.5) / 280, (i - 119.5) / 280, 1);
      double z = std::min(3.5, 1.1 / std::max(ray.y(), 1e-3));
      z = std::min(z, 1.4 / std::max(-ray.x(), 1e-3));
      z += 0.0014 * z * z * random.gauss();
      z = std::round(z / (0.0028 * z * z)) * 0.0028 * z * z;  // the steps of its disparity
      cloud.points.push_back((z * ray).cast<float>());
    }
  cloud.camera_frame = true;
  cloud.viewpoints = {Vec3::Zero()};
  ReconstructOptions options;
  apply_preset(options, preset_for(cloud));
  const ReconstructResult result = reconstruct(cloud, options);
  CHECK(validate(result.world).empty());
  CHECK(std::count_if(result.world.surfaces.begin(), result.world.surfaces.end(),
                      [](const Surface& surface) { return surface.source == Source::measured; }) ==
        3);
  for (const Vec3& normal : {Vec3(0, -1, 0), Vec3(0, 0, -1), Vec3(1, 0, 0)})
    CHECK(std::any_of(result.world.surfaces.begin(), result.world.surfaces.end(),
                      [&](const Surface& s) { return s.plane.normal.dot(normal) > 0.999; }));
  const auto none = std::count(result.labels.begin(), result.labels.end(), -1);
  CHECK(static_cast<double>(none) < 0.1 * static_cast<double>(result.labels.size()));
}
