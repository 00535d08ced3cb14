// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "scan/write_scan.h"

#include "scan/read_scan.h"
#include "support/scenes.h"

using namespace scanworld;
using namespace scanworld::test;

TEST_CASE("what is written as PLY or XYZ reads back the same, bit for bit") {
  const TempFolder folder;
  PointCloud cloud = room_points({3, 2, 2}, 0.2, 0.01);
  Random random(1);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    cloud.colors.push_back({static_cast<std::uint8_t>(random.whole(0, 255)), 7, 250});
    cloud.normals.push_back(random.direction().cast<float>());
  }
  for (const char* name : {"scan.ply", "scan.xyz", "scan.txt"}) {
    write_scan(folder / name, cloud);
    const PointCloud back = read_scan({folder / name});
    CHECK(back.points == cloud.points);
    CHECK(back.colors == cloud.colors);
    CHECK(back.normals == cloud.normals);
  }
}

TEST_CASE("points read back with the poses that they were seen from") {
  const TempFolder folder;
  PointCloud cloud = cloud_of({{1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
  cloud.viewpoints = {{0, 0, 1}, {5, 5, 1}};
  cloud.viewers = {1, -1, 0};
  for (const char* name : {"scan.ply", "scan.xyz"}) {
    write_scan(folder / name, cloud);
    const PointCloud back = read_scan({folder / name}, cloud.viewpoints);
    CHECK(back.points == cloud.points);
    CHECK(back.viewpoints == cloud.viewpoints);
    CHECK(back.viewers == cloud.viewers);
  }
}

TEST_CASE("a scan with an origin is written in its own coordinates") {
  const TempFolder folder;
  PointCloud cloud = cloud_of({{1.25, 2.5, 3}, {4, 5, 6}});
  cloud.origin = Vec3(500224, 5500416, 0);
  for (const char* name : {"scan.ply", "scan.xyz"}) {
    write_scan(folder / name, cloud);
    const PointCloud back = read_scan({folder / name});
    CHECK((back.points[0].cast<double>() + back.origin - Vec3(500225.25, 5500418.5, 3)).norm() <
          1e-6);
  }
}

TEST_CASE("labels are written for each point of the input, also for those that were left out") {
  const TempFolder folder;
  write_file(folder / "scan.xyz", "1 1 1\nnan 0 0\n2 2 2\n");
  const PointCloud cloud = read_scan({folder / "scan.xyz"});
  write_labels(folder / "labels.ply", cloud, {5, -1});
  const std::string bytes = read_file(folder / "labels.ply");
  CHECK(contains(bytes, "element vertex 3\n"));
  CHECK(contains(bytes, "property int plane_id\n"));
  const PointCloud back = read_scan({folder / "labels.ply"});
  CHECK(back.points == cloud.points);
  CHECK(back.skipped == cloud.skipped);
}

TEST_CASE("a scan is not written in a format that is none, nor where it cannot be") {
  const TempFolder folder;
  const PointCloud cloud = cloud_of({{1, 2, 3}});
  error_of(Cause::usage, [&] { write_scan(folder / "scan.doc", cloud); });
  CHECK(contains(error_of(Cause::failure, [&] { write_scan(folder / "no/such/scan.ply", cloud); }),
                 "scan.ply"));
}
