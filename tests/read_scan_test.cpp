// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "scan/read_scan.h"

#include "support/scenes.h"

using namespace scanworld;
using namespace scanworld::test;

TEST_CASE("the format is told by the extension, else by the first bytes") {
  const TempFolder folder;
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\n1 2 3\n";
  CHECK(read_scan({write_file(folder / "SCAN.PLY", ply)}).points.size() == 1);
  CHECK(read_scan({write_file(folder / "nameless", ply)}).points.size() == 1);
  CHECK(contains(
      error_of(Cause::bad_input, [&] { read_scan({write_file(folder / "scan.docx", "PK")}); }),
      "not a scan format"));
}

TEST_CASE("what is no readable file is told as such") {
  const TempFolder folder;
  CHECK(contains(error_of(Cause::bad_input, [&] { read_scan({folder / "absent.ply"}); }),
                 "No such file"));
  CHECK(contains(error_of(Cause::bad_input, [&] { read_scan({folder.path()}); }), "folder"));
  CHECK(contains(error_of(Cause::bad_input, [&] { read_scan({"/dev/null"}); }), "regular"));
  for (const char* name : {"empty.ply", "empty.pcd", "empty.xyz"})
    CHECK(contains(error_of(Cause::bad_input, [&] { read_scan({write_file(folder / name, "")}); }),
                   "empty"));
}

TEST_CASE("poses are read with three and with eight numbers a line") {
  const TempFolder folder;
  const auto poses =
      read_poses(write_file(folder / "poses.txt", "# x y z\n1 2 3\n\n12.5 4 5 6 0 0 0 1\n"));
  CHECK(poses == std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}});
  const auto error = [&](const char* text) {
    return error_of(Cause::bad_input, [&] { read_poses(write_file(folder / "poses.txt", text)); });
  };
  CHECK(contains(error("1 2 3\n1 2\n"), "poses.txt:2:"));
  CHECK(contains(error("1 2 north\n"), "'north'"));
  CHECK(contains(error("1 2 nan\n"), "not within"));
  CHECK(contains(error("# nothing\n"), "no poses"));
}

TEST_CASE("the fingerprint is that of the set of points") {
  PointCloud cloud = room_points({4, 3, 2.5}, 0.1, 0.01);
  const std::string before = fingerprint(cloud);
  CHECK(before.size() == 32);
  shuffle_points(cloud, 3);
  CHECK(fingerprint(cloud) == before);
  PointCloud moved = cloud;
  moved.points[17].x() += 1e-3f;
  CHECK(fingerprint(moved) != before);
  PointCloud twice = cloud;
  twice.points.push_back(twice.points[0]);
  twice.points.push_back(twice.points[0]);
  CHECK(fingerprint(twice) != before);
}
