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

namespace {

const std::vector<Vec3> kPoses = {{0, 0, 1}, {5, 0, 1}, {9, 0, 1}};

std::string ply_with_index(const std::string& type, const std::string& rows, int count) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty " + type +
         " scan_index\nend_header\n" + rows;
}

std::string pcd_from(const std::string& viewpoint, const std::string& rows, int count) {
  return "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + std::to_string(count) +
         "\nHEIGHT 1\nVIEWPOINT " + viewpoint + " 1 0 0 0\nPOINTS " + std::to_string(count) +
         "\nDATA ascii\n" + rows;
}

using Viewers = std::vector<std::int32_t>;

}  // namespace

TEST_CASE("scan_index counts the poses, whatever the format and the type") {
  const TempFolder folder;
  const std::string rows = "1 2 3 2\n4 5 6 -1\n7 8 9 0\n";
  std::vector<std::filesystem::path> files = {
      write_file(folder / "scan.csv", "x,y,z,scan_index\n1,2,3,2\n4,5,6,-1\n7,8,9,0\n"),
      write_file(folder / "scan.pcd",
                 "FIELDS x y z scan_index\nSIZE 4 4 4 4\nTYPE F F F I\nCOUNT 1 1 1 1\nWIDTH "
                 "3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n" +
                     rows)};
  for (const char* type : {"int", "char", "short", "float"})
    files.push_back(
        write_file(folder / (std::string(type) + ".ply"), ply_with_index(type, rows, 3)));
  for (const auto& file : files) {
    CAPTURE(file);
    CHECK(has_scan_index(file));
    const PointCloud cloud = read_scan({file}, kPoses);
    CHECK(cloud.points.size() == 3);
    CHECK(cloud.viewers == Viewers{2, -1, 0});
    CHECK(cloud.viewpoints == kPoses);
    const PointCloud without = read_scan({file});  // an index alone says nothing
    CHECK(without.viewers.empty());
    CHECK(without.viewpoints.empty());
    CHECK(without.points == cloud.points);
  }
}

TEST_CASE("an index that no pose has is told with its file and point") {
  const TempFolder folder;
  const auto good =
      write_file(folder / "good.ply", ply_with_index("uchar", "1 2 3 0\n4 5 6 1\n", 2));
  for (const char* bad : {"3", "1.5", "inf"}) {
    const auto file = write_file(folder / "bad.ply",
                                 ply_with_index("float", "1 2 3 2\n4 5 6 " + std::string(bad), 2));
    const std::string error = error_of(Cause::bad_input, [&] { read_scan({good, file}, kPoses); });
    CHECK(contains(error, "bad.ply: the scan_index of point 1 "));
    CHECK(contains(error, bad));
    CHECK(read_scan({file}).points.size() == 2);
  }
}

TEST_CASE("points left out take their indices with them, and files without one know none") {
  const TempFolder folder;
  const auto with =
      write_file(folder / "with.ply", ply_with_index("int", "1 2 3 0\nnan 5 6 99\n7 8 9 2\n", 3));
  const auto plain = write_file(folder / "plain.xyz", "1 1 1\n2 2 2\n");
  CHECK(read_scan({with, plain}, kPoses).viewers == Viewers{0, 2, -1, -1});
  CHECK(read_scan({plain, with}, kPoses).viewers == Viewers{-1, -1, 0, 2});
  CHECK(read_scan({plain}, kPoses).viewers.empty());
}

TEST_CASE("the points of several files were seen from the viewpoint of their own") {
  const TempFolder folder;
  const auto a = write_file(folder / "a.pcd", pcd_from("1 2 3", "4 5 6\n7 8 9\n", 2));
  const auto b = write_file(folder / "b.pcd", pcd_from("6 5 4", "1 1 1\n", 1));
  const auto c = write_file(folder / "c.xyz", "3 3 3\n");
  const PointCloud cloud = read_scan({a, c, b});
  CHECK(cloud.viewpoints == std::vector<Vec3>{{1, 2, 3}, {6, 5, 4}});
  CHECK(cloud.viewers == Viewers{0, 0, -1, 1});
  CHECK(read_scan({a}).viewers.empty());                  // its only viewpoint saw all
  CHECK(read_scan({a, b}, {{0, 0, 1}}).viewers.empty());  // poses replace those of files
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
