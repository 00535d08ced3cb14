// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "scan/assemble_cloud.h"

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

Rows rows_of(const std::vector<Vec3>& points) {
  Rows rows;
  rows.points = points;
  return rows;
}

}  // namespace

TEST_CASE(
    "coordinates of a map projection lose nothing: the origin moves into the scan in double") {
  Random random(3);
  std::vector<Vec3> points;
  for (int i = 0; i < 5000; ++i)
    points.emplace_back(500000.123456 + random.uniform(0, 40),
                        5500000.654321 + random.uniform(0, 40), 300 + random.uniform(0, 3));
  const PointCloud cloud = assemble_cloud({rows_in_memory("utm", rows_of(points))});
  CHECK(cloud.origin.z() == 0);
  for (std::size_t i = 0; i < points.size(); ++i)
    CHECK((cloud.points[i].cast<double>() + cloud.origin - points[i]).norm() < 1e-4);
}

TEST_CASE("the origin depends neither on the order of the points nor on a few that are far away") {
  Random random(4);
  std::vector<Vec3> points;
  for (int i = 0; i < 2000; ++i)
    points.emplace_back(1e6 + random.uniform(0, 30), -2e7 + random.uniform(0, 30),
                        random.uniform(0, 3));
  const Vec3 origin = assemble_cloud({rows_in_memory("a", rows_of(points))}).origin;
  shuffle(points, random);
  CHECK(assemble_cloud({rows_in_memory("a", rows_of(points))}).origin == origin);
  for (const Vec3& stray : {Vec3(0, 0, 0), Vec3(1e30, 0, 0), Vec3(-1e9, 1e9, 1e12)}) {
    std::vector<Vec3> more = points;
    more.push_back(stray);
    CHECK(assemble_cloud({rows_in_memory("a", rows_of(more))}).origin == origin);
  }
}

TEST_CASE("a scan near zero keeps its coordinates, also with one point far away") {
  std::vector<Vec3> points(100, Vec3(1, 2, 3));
  points.emplace_back(1e7, 0, 0);
  const PointCloud cloud = assemble_cloud({rows_in_memory("a", rows_of(points))});
  CHECK(cloud.origin.isZero());
  CHECK(cloud.points[0] == Vec3f(1, 2, 3));
}

TEST_CASE("rows that are not finite are left out of points, normals and colours alike") {
  Rows rows =
      rows_of({{1, 1, 1}, {NAN, 0, 0}, {2, 2, 2}, {0, INFINITY, 0}, {3, 3, 3}, {1e300, 0, 0}});
  for (int i = 0; i < 6; ++i) {
    rows.normals.push_back(Vec3f::Constant(static_cast<float>(i)));
    rows.colors.push_back({static_cast<std::uint8_t>(i), 0, 0});
  }
  const PointCloud cloud = assemble_cloud({rows_in_memory("a", rows)});
  CHECK(cloud.skipped == std::vector<std::size_t>{1, 3, 5});
  REQUIRE(cloud.points.size() == 3);
  CHECK(cloud.points[2] == Vec3f(3, 3, 3));
  CHECK(cloud.normals[1] == Vec3f(2, 2, 2));
  CHECK(cloud.colors[2].r == 4);
}

TEST_CASE("a file with nothing finite in it is refused") {
  CHECK(contains(
      error_of(
          Cause::bad_input,
          [] {
            assemble_cloud({rows_in_memory("a.ply", rows_of({{NAN, 0, 0}, {0, INFINITY, 0}}))});
          }),
      "none of its 2 points"));
  CHECK(contains(
      error_of(Cause::bad_input, [] { assemble_cloud({rows_in_memory("a.ply", Rows{})}); }),
      "no points"));
}

TEST_CASE("several files give the cloud that one file with all their points gives") {
  Random random(5);
  std::vector<Vec3> points;
  for (int i = 0; i < 3000; ++i)
    points.emplace_back(600000 + random.uniform(0, 3000), random.uniform(0, 30),
                        random.uniform(0, 3));
  const PointCloud whole = assemble_cloud({rows_in_memory("a", rows_of(points))});
  const std::vector<Vec3> first(points.begin(), points.begin() + 700),
      second(points.begin() + 700, points.end());
  const PointCloud parts =
      assemble_cloud({rows_in_memory("a", rows_of(first)), rows_in_memory("b", rows_of(second))});
  CHECK(parts.origin == whole.origin);
  CHECK(parts.points == whole.points);
}

TEST_CASE("attributes that not all files have are left out") {
  Rows with = rows_of({{1, 1, 1}});
  with.colors.push_back({1, 2, 3});
  CHECK(assemble_cloud({rows_in_memory("a", with)}).colors.size() == 1);
  CHECK(assemble_cloud({rows_in_memory("a", with), rows_in_memory("b", rows_of({{2, 2, 2}}))})
            .colors.empty());
}

TEST_CASE("incomplete or repeated columns are not used") {
  using enum Role;
  CHECK(usable_roles({x, y, z, nx, ny}, "f", "columns") == std::vector<Role>{x, y, z, none, none});
  CHECK(usable_roles({x, y, x, z, red, green, blue, packed_rgb}, "f", "columns") ==
        std::vector<Role>{x, y, none, z, red, green, blue, none});
  CHECK(contains(error_of(Cause::bad_input,
                          [] {
                            usable_roles({x, z}, "f.csv", "the columns");
                          }),
                 "f.csv: the columns have no 'y'"));
}

TEST_CASE("normals that were never set are none; a few of them are zero") {
  Rows rows = rows_of(std::vector<Vec3>(10, Vec3(1, 2, 3)));
  rows.normals.assign(10, Vec3f::UnitZ());
  rows.normals[3] = Vec3f::Zero(), rows.normals[7] = Vec3f::Constant(NAN);
  const PointCloud some = assemble_cloud({rows_in_memory("a", rows)});
  REQUIRE(some.normals.size() == 10);
  for (std::size_t i : {3u, 7u}) CHECK(some.normals[i].isZero(0));
  CHECK(some.normals[0] == Vec3f::UnitZ());
  for (float unset : {0.0f, NAN}) {
    rows.normals.assign(10, Vec3f::Constant(unset));
    CHECK(assemble_cloud({rows_in_memory("a", rows)}).normals.empty());
  }
}
