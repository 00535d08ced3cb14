// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "scan/ply.h"

#include <cstring>

#include "scan/read_scan.h"
#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

template <typename T>
void put(std::string& bytes, T value, bool swap) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (swap) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

std::string header(const std::string& format, const std::string& elements) {
  return "ply\nformat " + format + " 1.0\ncomment made by hand\n" + elements + "end_header\n";
}

// The same three points with everything in the way: a property of each type before the coordinates.
template <typename T>
std::string binary_scan(bool big_endian, const char* type) {
  std::string bytes = header(
      big_endian ? "binary_big_endian" : "binary_little_endian",
      std::string("element camera 2\nproperty double focus\nproperty uchar on\nelement vertex 3\n"
                  "property uchar red\nproperty short intensity\nproperty ") +
          type + " x\nproperty " + type + " y\nproperty int id\nproperty " + type +
          " z\nproperty uchar green\nproperty uchar blue\nelement face 0\n"
          "property list uchar int vertex_indices\n");
  for (int i = 0; i < 2; ++i) put(bytes, 1.5, big_endian), put(bytes, std::uint8_t{1}, big_endian);
  for (int i = 0; i < 3; ++i) {
    put(bytes, static_cast<std::uint8_t>(10 + i), big_endian);
    put(bytes, static_cast<std::int16_t>(-5), big_endian);
    put(bytes, static_cast<T>(i + 0.25), big_endian);
    put(bytes, static_cast<T>(-i), big_endian);
    put(bytes, 77, big_endian);
    put(bytes, static_cast<T>(100 * i), big_endian);
    put(bytes, static_cast<std::uint8_t>(20 + i), big_endian);
    put(bytes, static_cast<std::uint8_t>(30 + i), big_endian);
  }
  return bytes;
}

PointCloud read_ply(const TempFolder& folder, const std::string& bytes) {
  return read_scan({write_file(folder / "scan.ply", bytes)});
}

std::string ply_error(const TempFolder& folder, const std::string& bytes) {
  return error_of(Cause::bad_input, [&] { read_ply(folder, bytes); });
}

}  // namespace

TEST_CASE("PLY: both byte orders, float and double, are read past other properties and elements") {
  const TempFolder folder;
  for (bool big_endian : {false, true})
    for (const std::string& bytes :
         {binary_scan<float>(big_endian, "float"), binary_scan<double>(big_endian, "double")}) {
      const PointCloud cloud = read_ply(folder, bytes);
      REQUIRE(cloud.points.size() == 3);
      for (int i = 0; i < 3; ++i) {
        const std::size_t k = static_cast<std::size_t>(i);
        CHECK(cloud.points[k] == Vec3f(static_cast<float>(i) + 0.25f, static_cast<float>(-i),
                                       static_cast<float>(100 * i)));
        CHECK(cloud.colors[k] == Color{static_cast<std::uint8_t>(10 + i),
                                       static_cast<std::uint8_t>(20 + i),
                                       static_cast<std::uint8_t>(30 + i)});
      }
      CHECK(cloud.normals.empty());
    }
}

TEST_CASE("PLY: ascii is read with normals, colours, other columns and elements before and after") {
  const TempFolder folder;
  const PointCloud cloud = read_ply(
      folder,
      header(
          "ascii",
          "element note 2\nproperty int n\nelement vertex 2\nproperty float x\nproperty float y\n"
          "property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty "
          "float quality\n"
          "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
          "property list uchar int vertex_indices\n") +
          "1\n2\n1 2 3 0 0 1 0.5 255 128 0\n-1.5 1e2 +0.25 1 0 0 0.5 1 2 3\n3 0 1 0\n");
  REQUIRE(cloud.points.size() == 2);
  CHECK(cloud.points[0] == Vec3f(1, 2, 3));
  CHECK(cloud.points[1] == Vec3f(-1.5f, 100, 0.25f));
  CHECK(cloud.normals[1] == Vec3f(1, 0, 0));
  CHECK(cloud.colors[0] == Color{255, 128, 0});
}

TEST_CASE("PLY: Windows line ends are understood") {
  const TempFolder folder;
  const PointCloud cloud = read_ply(
      folder,
      "ply\r\nformat ascii 1.0\r\nelement vertex 1\r\nproperty float x\r\nproperty float y\r\n"
      "property float z\r\nend_header\r\n1 2 3\r\n");
  CHECK(cloud.points[0] == Vec3f(1, 2, 3));
}

TEST_CASE("PLY: colours of 16 bits and as shares of one become 8 bits") {
  const TempFolder folder;
  std::string bytes =
      header("binary_little_endian",
             "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
             "property ushort red\nproperty float green\nproperty ushort blue\n");
  for (float v : {1.f, 2.f, 3.f}) put(bytes, v, false);
  put(bytes, std::uint16_t{65535}, false), put(bytes, 0.5f, false),
      put(bytes, std::uint16_t{257}, false);
  CHECK(read_ply(folder, bytes).colors[0] == Color{255, 128, 1});
}

TEST_CASE("PLY: lists before the vertices are passed over") {
  const TempFolder folder;
  std::string bytes =
      header("binary_little_endian",
             "element strip 2\nproperty list ushort int index\nproperty uchar end\n"
             "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n");
  for (std::uint16_t n : {std::uint16_t{3}, std::uint16_t{0}}) {
    put(bytes, n, false);
    for (int i = 0; i < n; ++i) put(bytes, i, false);
    put(bytes, std::uint8_t{9}, false);
  }
  for (float v : {1.f, 2.f, 3.f}) put(bytes, v, false);
  CHECK(read_ply(folder, bytes).points[0] == Vec3f(1, 2, 3));
}

TEST_CASE(
    "PLY: a header that promises more than the file holds is refused before memory is taken") {
  const TempFolder folder;
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  for (const char* format : {"ascii", "binary_little_endian"}) {
    const std::string message =
        ply_error(folder, header(format, "element vertex 1000000000000\n" + xyz) + "1 2 3\n");
    CHECK(contains(message, "1000000000000"));
    CHECK(contains(message, "scan.ply"));
    ply_error(folder, header(format, "element vertex 18446744073709551615\n" + xyz) + "1 2 3\n");
  }
}

TEST_CASE(
    "PLY: a file that is cut off is refused, in the header, in a binary body and in an ascii "
    "body") {
  const TempFolder folder;
  const std::string whole = binary_scan<float>(false, "float");
  const std::size_t body = whole.find("end_header\n") + 11;
  for (std::size_t length :
       {std::size_t{1}, std::size_t{30}, body - 5, body + 1, body + 20, whole.size() - 1})
    CHECK(contains(ply_error(folder, whole.substr(0, length)), "scan.ply"));
  const std::string message = ply_error(
      folder,
      header("ascii", "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n") +
          "1 2 3.00000000000000\n4 5 6.00000000000000\n");
  CHECK(contains(message, "promises 3"));
  CHECK(contains(message, "after 2"));
}

TEST_CASE("PLY: errors in the header name the line and the word") {
  const TempFolder folder;
  CHECK(contains(ply_error(folder, "plx\n"), ":1:"));
  CHECK(contains(ply_error(folder, "ply\nformat weird 1.0\n"), "'weird'"));
  CHECK(contains(ply_error(folder, header("ascii", "element vertex many\n")), "'many'"));
  CHECK(contains(ply_error(folder, header("ascii", "element vertex 1\nproperty quux x\n")),
                 "'quux'"));
  CHECK(contains(ply_error(folder, header("ascii", "property float x\n")),
                 "before the first element"));
  CHECK(contains(
      ply_error(folder, header("ascii", "element vertex 1\nproperty float x\nproperty float y\n") +
                            "1 2\n"),
      "'z'"));
  CHECK(contains(ply_error(folder, header("ascii", "element face 1\nproperty float x\n") + "1\n"),
                 "vertex"));
  CHECK(contains(ply_error(folder, "ply\nelement vertex 0\nproperty float x\nend_header\n"),
                 "format"));
  CHECK(contains(
      ply_error(folder,
                header("ascii", "element vertex 1\nproperty list uchar float x\n") + "1 2\n"),
      "list"));
}

TEST_CASE("PLY: a word among the numbers is named with its line") {
  const TempFolder folder;
  const std::string message = ply_error(
      folder,
      header("ascii", "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n") +
          "1 2 3\n4 five 6\n");
  CHECK(contains(message, ":10:"));
  CHECK(contains(message, "'five'"));
}

TEST_CASE("PLY: a mesh is told from a scan by its faces") {
  const TempFolder folder;
  const std::string vertex =
      "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  CHECK_FALSE(is_ply_mesh(write_file(folder / "scan.ply", header("ascii", vertex) + "1 2 3\n")));
  CHECK(is_ply_mesh(write_file(
      folder / "mesh.ply",
      header("ascii", vertex + "element face 1\nproperty list uchar int vertex_indices\n") +
          "1 2 3\n3 0 0 0\n")));
}
