// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "scan/pcd.h"

#include <liblzf/lzf.h>

#include <cstring>

#include "scan/read_scan.h"
#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

std::string header(const std::string& fields, const std::string& sizes, const std::string& types,
                   const std::string& counts, int width, int height, const std::string& data,
                   const std::string& viewpoint = "0 0 0 1 0 0 0") {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " +
         sizes + "\nTYPE " + types + "\nCOUNT " + counts + "\nWIDTH " + std::to_string(width) +
         "\nHEIGHT " + std::to_string(height) + "\nVIEWPOINT " + viewpoint + "\nPOINTS " +
         std::to_string(width * height) + "\nDATA " + data + "\n";
}

template <typename T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

std::string compress(const std::string& bytes) {
  std::string packed(2 * bytes.size() + 100, '\0');
  const unsigned size = lzf_compress(bytes.data(), static_cast<unsigned>(bytes.size()),
                                     packed.data(), static_cast<unsigned>(packed.size()));
  REQUIRE(size > 0);
  std::string result;
  put(result, size);
  put(result, static_cast<std::uint32_t>(bytes.size()));
  return result + packed.substr(0, size);
}

PointCloud read_pcd(const TempFolder& folder, const std::string& bytes) {
  return read_scan({write_file(folder / "scan.pcd", bytes)});
}

std::string pcd_error(const TempFolder& folder, const std::string& bytes) {
  return error_of(Cause::bad_input, [&] { read_pcd(folder, bytes); });
}

const std::string kXyz = header("x y z", "4 4 4", "F F F", "1 1 1", 2, 1, "binary");

}  // namespace

TEST_CASE("PCD: ascii, binary and binary_compressed hold the same points and colours") {
  const TempFolder folder;
  const std::uint32_t red = 0x00ff0102, green = 0x0003ff04;
  std::string rows, columns;
  for (int i = 0; i < 2; ++i) {
    for (float v : {1.5f + static_cast<float>(i), -2.f, 3.f}) put(rows, v);
    put(rows, i == 0 ? red : green);
    put(rows, 0.25f), put(rows, 0.5f);
  }
  for (float v : {1.5f, 2.5f, -2.f, -2.f, 3.f, 3.f}) put(columns, v);
  put(columns, red), put(columns, green);
  for (int i = 0; i < 4; ++i) put(columns, 0.25f);
  const auto start = [](const char* data) {
    return header("x y z rgb hist", "4 4 4 4 4", "F F F U F", "1 1 1 1 2", 2, 1, data);
  };
  for (const std::string& bytes :
       {start("ascii") + "1.5 -2 3 16711938 0.25 0.5\n2.5 -2 3 261892 0.25 0.5\n",
        start("binary") + rows, start("binary_compressed") + compress(columns)}) {
    const PointCloud cloud = read_pcd(folder, bytes);
    REQUIRE(cloud.points.size() == 2);
    CHECK(cloud.points[0] == Vec3f(1.5f, -2, 3));
    CHECK(cloud.points[1] == Vec3f(2.5f, -2, 3));
    CHECK(cloud.colors[0] == Color{255, 1, 2});
    CHECK(cloud.colors[1] == Color{3, 255, 4});
  }
}

TEST_CASE("PCD: a colour packed into a float, as number or text, is unpacked") {
  const TempFolder folder;
  const std::uint32_t bits = 0x00102030;
  float packed = 0;
  std::memcpy(&packed, &bits, 4);
  std::string rows;
  for (float v : {1.f, 2.f, 3.f, packed}) put(rows, v);
  char text[64];
  std::snprintf(text, sizeof(text), "1 2 3 %.9g\n", static_cast<double>(packed));
  for (const std::string& bytes :
       {header("x y z rgb", "4 4 4 4", "F F F F", "1 1 1 1", 1, 1, "binary") + rows,
        header("x y z rgb", "4 4 4 4", "F F F F", "1 1 1 1", 1, 1, "ascii") + text})
    CHECK(read_pcd(folder, bytes).colors[0] == Color{0x10, 0x20, 0x30});
}

TEST_CASE("PCD: normals and double coordinates are read") {
  const TempFolder folder;
  std::string rows;
  for (double v : {1.0, 2.0, 3.0}) put(rows, v);
  for (float v : {0.f, 0.f, 1.f}) put(rows, v);
  const PointCloud cloud =
      read_pcd(folder, header("x y z normal_x normal_y normal_z", "8 8 8 4 4 4", "F F F F F F",
                              "1 1 1 1 1 1", 1, 1, "binary") +
                           rows);
  CHECK(cloud.points[0] == Vec3f(1, 2, 3));
  CHECK(cloud.normals[0] == Vec3f(0, 0, 1));
}

TEST_CASE("PCD: points that are not finite are left out and remembered") {
  const TempFolder folder;
  const PointCloud cloud =
      read_pcd(folder, header("x y z", "4 4 4", "F F F", "1 1 1", 4, 1, "ascii") +
                           "nan nan nan\n1 2 3\n4 inf 6\n7 8 9\n");
  CHECK(cloud.points.size() == 2);
  CHECK(cloud.skipped == std::vector<std::size_t>{0, 2});
  CHECK(cloud.input_size() == 4);
}

TEST_CASE("PCD: VIEWPOINT counts where it says something") {
  const TempFolder folder;
  const auto viewpoints = [&](int width, int height, const std::string& viewpoint) {
    std::string text =
        header("x y z", "4 4 4", "F F F", "1 1 1", width, height, "ascii", viewpoint);
    for (int i = 0; i < width * height; ++i) text += "1 2 3\n";
    return read_pcd(folder, text).viewpoints;
  };
  CHECK(viewpoints(4, 1, "0 0 0 1 0 0 0").empty());
  CHECK(viewpoints(4, 1, "1 2 3 1 0 0 0") == std::vector<Vec3>{{1, 2, 3}});
  CHECK(viewpoints(2, 2, "0 0 0 1 0 0 0") == std::vector<Vec3>{{0, 0, 0}});
}

TEST_CASE(
    "PCD: an organised cloud with the rays of a pinhole is taken for a camera's image, a laser "
    "scan is not") {
  const TempFolder folder;
  std::string camera = header("x y z", "4 4 4", "F F F", "1 1 1", 40, 30, "ascii");
  std::string laser = camera;
  Random random(1);
  for (int v = 0; v < 30; ++v)
    for (int u = 0; u < 40; ++u) {
      const double z = random.uniform(1, 4), x = (u - 20) * z / 40, y = (v - 15) * z / 40;
      camera += u % 7 == 0
                    ? "nan nan nan\n"
                    : std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
      const double azimuth = u * 0.1, elevation = (v - 15) * 0.05;
      laser += std::to_string(z * std::cos(azimuth)) + " " + std::to_string(z * std::sin(azimuth)) +
               " " + std::to_string(z * std::tan(elevation)) + "\n";
    }
  CHECK(read_pcd(folder, camera).camera_frame);
  CHECK_FALSE(read_pcd(folder, laser).camera_frame);
}

TEST_CASE("PCD: promises that the file does not keep are refused") {
  const TempFolder folder;
  std::string two = kXyz;
  for (int i = 0; i < 6; ++i) put(two, 1.f);
  CHECK(read_pcd(folder, two).points.size() == 2);
  CHECK(contains(pcd_error(folder, two.substr(0, two.size() - 1)), "room for 1"));
  CHECK(contains(pcd_error(folder, kXyz.substr(0, 60)), "header"));
  std::string huge = kXyz;
  huge.replace(huge.find("POINTS 2"), 8, "POINTS 1000000000000");
  CHECK(contains(pcd_error(folder, huge), "1000000000000"));
  std::string columns;
  for (int i = 0; i < 6; ++i) put(columns, 1.f);
  const std::string packed =
      header("x y z", "4 4 4", "F F F", "1 1 1", 2, 1, "binary_compressed") + compress(columns);
  CHECK(read_pcd(folder, packed).points.size() == 2);
  CHECK(contains(pcd_error(folder, packed.substr(0, packed.size() - 2)), "compressed"));
  std::string damaged = packed;
  damaged[packed.find("binary_compressed\n") + 18 + 8] =
      '\x3f';  // a run of literals longer than the data
  CHECK(contains(pcd_error(folder, damaged), "damaged"));
  std::string bomb = packed;
  const std::uint32_t claimed = 4000000000u;
  std::memcpy(bomb.data() + packed.find("binary_compressed\n") + 18 + 4, &claimed, 4);
  CHECK(contains(pcd_error(folder, bomb), "cannot hold"));
}

TEST_CASE("PCD: errors in the header name the line and the word") {
  const TempFolder folder;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = kXyz + std::string(24, '\0');
    text.replace(text.find(from), from.size(), to);
    return pcd_error(folder, text);
  };
  CHECK(contains(with("SIZE 4 4 4", "SIZE 4 four 4"), "'four'"));
  CHECK(contains(with("TYPE F F F", "TYPE F F"), "types"));
  CHECK(contains(with("DATA binary", "DATA morse"), "'morse'"));
  CHECK(contains(with("WIDTH 2", "BREADTH 2"), "'BREADTH'"));
  CHECK(contains(with("FIELDS x y z", "FIELDS x y w"), "'z'"));
  CHECK(contains(with("SIZE 4 4 4", "SIZE 4 4 3"), "F3"));
  CHECK(contains(with("VIEWPOINT 0 0 0 1 0 0 0", "VIEWPOINT 0 0 0"), "VIEWPOINT"));
}
