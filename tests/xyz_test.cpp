// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "scan/xyz.h"

#include <zlib.h>

#include "scan/read_scan.h"
#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

PointCloud read(const TempFolder& folder, const std::string& text, const char* name = "scan.xyz") {
  return read_scan({write_file(folder / name, text)});
}

std::string error_in(const TempFolder& folder, const std::string& text,
                     const char* name = "scan.xyz") {
  return error_of(Cause::bad_input, [&] { read(folder, text, name); });
}

void write_gzip(const std::filesystem::path& path, const std::string& text) {
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
}

}  // namespace

TEST_CASE("XYZ: any separator, comments, blank lines and missing line ends are understood") {
  const TempFolder folder;
  for (const char* text : {"1 2 3\n4 5 6\n", "1,2,3\n4,5,6", "1;2;3\r\n4;5;6\r\n",
                           "1\t2\t3\n\n# note\n// note\n4\t5\t6\n", " 1 ,  2 ,3 \n4 , 5,  6,\n",
                           "+1 2.0e0 3.\n0.4e1 .5e1 6\n"}) {
    const PointCloud cloud = read(folder, text);
    REQUIRE(cloud.points.size() == 2);
    CHECK(cloud.points[0] == Vec3f(1, 2, 3));
    CHECK(cloud.points[1] == Vec3f(4, 5, 6));
  }
}

TEST_CASE("XYZ: a line of names tells the columns, in any order and also in a comment") {
  const TempFolder folder;
  for (const char* names :
       {"intensity,z,y,x,B,G,R", "//intensity z y x b g r", "# Intensity Z Y X blue green red",
        "\"i\";\"z\";\"y\";\"x\";\"b\";\"g\";\"r\""}) {
    const PointCloud cloud = read(folder, std::string(names) + "\n0.5 3 2 1 30 20 10\n");
    REQUIRE(cloud.points.size() == 1);
    CHECK(cloud.points[0] == Vec3f(1, 2, 3));
    CHECK(cloud.colors[0] == Color{10, 20, 30});
  }
}

TEST_CASE("XYZ: without names columns are told by their values") {
  const TempFolder folder;
  CHECK(read(folder, "1 2 3 99\n").colors.empty());
  CHECK(read(folder, "1 2 3 10 20 30\n").colors[0] == Color{10, 20, 30});
  CHECK(read(folder, "1 2 3 0.6 0.8 0\n").normals[0] == Vec3f(0.6f, 0.8f, 0));
  CHECK(read(folder, "1 2 3 -1200 10 20 30\n").colors[0] == Color{10, 20, 30});
  const PointCloud both = read(folder, "1 2 3 10 20 30 0 0 1\n");
  CHECK(both.colors[0] == Color{10, 20, 30});
  CHECK(both.normals[0] == Vec3f(0, 0, 1));
  const PointCloud neither = read(folder, "1 2 3 0.5 0.5 0.5\n1 2 3 500 1 1\n");
  CHECK(neither.colors.empty());
  CHECK(neither.normals.empty());
}

TEST_CASE("PTS: count lines are no points, also in the middle, and promise how many follow") {
  const TempFolder folder;
  const PointCloud cloud =
      read(folder, "2\n1 2 3 -5 1 2 3\n4 5 6 -5 4 5 6\n1\n7 8 9 -5 7 8 9\n", "scan.pts");
  CHECK(cloud.points.size() == 3);
  CHECK(cloud.colors[2] == Color{7, 8, 9});
  CHECK(contains(error_in(folder, "5\n1 2 3 0 0 0 0\n", "scan.pts"), "promises 5"));
  CHECK(contains(error_in(folder, "1000000000000\n1 2 3 0 0 0 0\n", "scan.pts"),
                 "promises 1000000000000"));
}

TEST_CASE("XYZ: a word or a missing value is named with file, line and place") {
  const TempFolder folder;
  std::string text;
  for (int i = 0; i < 200000; ++i) text += "1.25 2.5 3.75\n";
  CHECK(contains(error_in(folder, text + "1 two 3\n" + text), "scan.xyz:200001: 'two' (value 2)"));
  CHECK(contains(error_in(folder, text + "1 2\n"), ":200001: has 2 values, 3 are needed"));
  CHECK(contains(error_in(folder, "1 2 3\n1,,3\n"), ":2: value 2 is empty"));
  CHECK(contains(error_in(folder, "1 2 3x\n"), "'3x'"));
  CHECK(contains(error_in(folder, "hello\n"), "'hello'"));
  CHECK(contains(error_in(folder, "1 2 0x10\n"), "'0x10'"));
  CHECK(contains(error_in(folder, "# nothing here\n\n"), "no points"));
}

TEST_CASE("XYZ: a line without end is refused without reading it whole") {
  const TempFolder folder;
  CHECK(contains(error_in(folder, "1 2 3\n" + std::string(8 << 20, '7')), "longer than"));
}

TEST_CASE("XYZ: numbers are rounded correctly, however they are written") {
  const TempFolder folder;
  Random random(7);
  std::string text;
  std::vector<double> values;
  for (int i = 0; i < 3000; ++i) {
    const double v = random.gauss() * std::pow(10, random.whole(-12, 12));
    const char* formats[] = {"%.17g", "%.3f", "%.6f", "%.15f", "%g", "%.12e", "%+.4f"};
    char word[512];
    std::snprintf(word, sizeof(word), formats[random.whole(0, 6)], v);
    values.push_back(std::strtod(word, nullptr));
    text += word;
    text += i % 3 == 2 ? '\n' : ' ';
  }
  const PointCloud cloud = read(folder, text);
  REQUIRE(cloud.points.size() == 1000);
  for (std::size_t i = 0; i < 3000; ++i)
    CHECK(cloud.points[i / 3][static_cast<int>(i % 3)] ==
          static_cast<float>(values[i] - cloud.origin[static_cast<int>(i % 3)]));
}

TEST_CASE("gzip of the text forms is read, and damage in it is told") {
  const TempFolder folder;
  std::string text;
  for (int i = 0; i < 100000; ++i) text += std::to_string(i % 100) + " 2 3\n";
  write_gzip(folder / "scan.xyz.gz", text);
  CHECK(read_scan({folder / "scan.xyz.gz"}).points.size() == 100000);
  write_gzip(folder / "scan.ply.gz",
             "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float "
             "y\nproperty float z\nend_header\n1 2 3\n");
  CHECK(read_scan({folder / "scan.ply.gz"}).points.size() == 1);
  write_gzip(folder / "scan.pcd.gz",
             "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA "
             "binary\n123456789012");
  CHECK(
      contains(error_of(Cause::bad_input, [&] { read_scan({folder / "scan.pcd.gz"}); }), "gunzip"));

  const std::string packed = read_file(folder / "scan.xyz.gz");
  write_file(folder / "cut.xyz.gz", packed.substr(0, packed.size() / 2));
  CHECK(contains(error_of(Cause::bad_input, [&] { read_scan({folder / "cut.xyz.gz"}); }), "gzip"));
  std::string damaged = packed;
  damaged[packed.size() / 2] = static_cast<char>(damaged[packed.size() / 2] ^ 0x55);
  write_file(folder / "bad.xyz.gz", damaged);
  error_of(Cause::bad_input, [&] { read_scan({folder / "bad.xyz.gz"}); });
}
