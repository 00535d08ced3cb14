// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sim_check/baselines/growing_grid.h"

#include "support/meshes.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::sim;

namespace {

// The longer and the shorter side of the lattice that a mesh is, in nodes.
std::pair<int, int> lattice_of(const Mesh& mesh) {
  const int nodes = static_cast<int>(mesh.vertices.size()),
            faces = static_cast<int>(mesh.triangles.size());
  // r c = nodes and 2 (r - 1)(c - 1) = faces.
  const double sum = nodes + 1 - faces / 2.0, root = std::sqrt(sum * sum - 4.0 * nodes);
  return {static_cast<int>(std::lround((sum + root) / 2)),
          static_cast<int>(std::lround((sum - root) / 2))};
}

void check_lattice(const Mesh& mesh, int nodes) {
  check_dense_mesh(mesh);
  const auto [longer, shorter] = lattice_of(mesh);
  CHECK(shorter >= 2);
  CHECK(mesh.vertices.size() == static_cast<std::size_t>(longer * shorter));
  CHECK(mesh.triangles.size() == static_cast<std::size_t>(2 * (longer - 1) * (shorter - 1)));
  CHECK(border_edges(mesh) == 2 * (longer + shorter - 2));
  CHECK(longer * shorter >= nodes);
  CHECK(longer * shorter - longer < nodes);  // without the last row
}

PointCloud rectangle_points(const Vec3& a, const Vec3& b, double spacing) {
  Random random(1);
  PointCloud cloud;
  add_rectangle(cloud, Vec3::Zero(), a, b, spacing, 0, random);
  return cloud;
}

// [m2] Of points from the nearest vertex, squared.
double mean_square_distance(const PointCloud& cloud, const Mesh& mesh) {
  double sum = 0;
  for (const Vec3f& p : cloud.points) {
    const Vec3 point = p.cast<double>();
    sum += (nearest_of(mesh.vertices, point) - point).squaredNorm();
  }
  return sum / static_cast<double>(cloud.points.size());
}

}  // namespace

TEST_CASE("a growing grid has the nodes and triangles of its lattice") {
  const FurnishedRoom room(5000);
  for (const int nodes : {5, 6, 40, 150})
    check_lattice(growing_grid(room.cloud, {.nodes = nodes}), nodes);
}

TEST_CASE("a growing grid lies flat on a rectangle, and is as long as it") {
  const Mesh mesh = growing_grid(rectangle_points({4, 0, 0}, {0, 0, 1}, 0.05), {.nodes = 120});
  check_lattice(mesh, 120);
  double area = 0, along = 0;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    area += triangle_area(mesh, t);
    along += (at(1) - at(0)).cross(at(2) - at(0)).y() / 2;
  }
  CHECK(area == doctest::Approx(std::abs(along)));  // no triangle is turned over
  CHECK(area > 0.35 * 4);
  CHECK(area < 4);
  for (const Vec3& v : mesh.vertices) CHECK(std::abs(v.y()) < 1e-9);
  const auto [longer, shorter] = lattice_of(mesh);
  CHECK(longer > 2 * shorter);
}

TEST_CASE("a growing grid grows where most points are, and where its nodes are far apart") {
  const std::vector<Vec3> corners = {{0, 0, 0}, {3, 0, 0}, {0, 1, 0}, {3, 1, 0}};
  std::vector<Vec3> points;
  for (int i = 0; i < 20; ++i) points.insert(points.end(), corners.begin(), corners.end());
  points.insert(points.end(), 100, corners[0]);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    // Nodes that hardly move: each is where it was inserted.
    const Mesh mesh = growing_grid(
        cloud_of(points),
        {.nodes = 40, .eps = 1e-12, .lambda_fine = 0, .eps_fine = 1e-12, .seed = seed});
    check_lattice(mesh, 40);
    const auto near = std::count_if(mesh.vertices.begin(), mesh.vertices.end(),
                                    [&](const Vec3& v) { return (v - corners[0]).norm() < 0.4; });
    CHECK(near >= 6);
  }
}

TEST_CASE("fine-tuning brings the nodes of a growing grid nearer to the points") {
  const FurnishedRoom room(5000);
  const Mesh grown = growing_grid(room.cloud, {.nodes = 60, .lambda_fine = 0}),
             tuned = growing_grid(room.cloud, {.nodes = 60});
  CHECK(grown.triangles == tuned.triangles);
  CHECK(mean_square_distance(room.cloud, tuned) < 0.98 * mean_square_distance(room.cloud, grown));
}

TEST_CASE("the order of the points does not matter to a growing grid, the seed does") {
  FurnishedRoom room(3000);
  const Mesh before = growing_grid(room.cloud, {.nodes = 40});
  shuffle_points(room.cloud, 5);
  CHECK(is_same(growing_grid(room.cloud, {.nodes = 40}), before));
  CHECK_FALSE(is_same(growing_grid(room.cloud, {.nodes = 40, .seed = 2}), before));
}

TEST_CASE("a growing grid is where the origin of the cloud says") {
  PointCloud cloud = rectangle_points({4, 0, 0}, {0, 0, 1}, 0.1);
  cloud.origin = Vec3(1000, 2000, 3000);
  Box3 box;
  for (const Vec3& v : growing_grid(cloud, {.nodes = 50}).vertices) box.extend(v);
  CHECK(Box3(Vec3(1000, 1999.9, 3000), Vec3(1004, 2000.1, 3001)).contains(box));
  CHECK(box.sizes().x() > 2.5);
}

TEST_CASE("a growing grid tells how far it is") {
  std::vector<double> told;
  growing_grid(FurnishedRoom(3000).cloud, {.nodes = 60},
               [&](std::string_view, double fraction) { told.push_back(fraction); });
  CHECK(told.size() > 10);
  CHECK(std::is_sorted(told.begin(), told.end()));
  CHECK(told.front() >= 0);
  CHECK(told.back() <= 1);
}

TEST_CASE("a growing grid refuses scans that are too small and options out of range") {
  const PointCloud cloud = FurnishedRoom(1000).cloud;
  const auto refused = [](const PointCloud& points, const GrowingGridOptions& options,
                          Cause cause) {
    return error_of(cause, [&] { growing_grid(points, options); });
  };
  CHECK(contains(refused({}, {}, Cause::bad_input), "0 points"));
  CHECK(contains(refused(cloud, {.nodes = 9999}, Cause::bad_input), "9999 nodes"));
  CHECK(contains(
      refused(cloud_of(std::vector<Vec3>(99, Vec3(1, 2, 3))), {.nodes = 50}, Cause::bad_input),
      "different"));
  CHECK(contains(refused(cloud, {.nodes = 4}, Cause::usage), "nodes"));
  CHECK(contains(refused(cloud, {.nodes = 50, .lambda = 0}, Cause::usage), "lambda"));
  CHECK(contains(refused(cloud, {.nodes = 50, .eps = 2}, Cause::usage), "eps"));
  CHECK(contains(refused(cloud, {.nodes = 50, .sigma = NAN}, Cause::usage), "sigma"));
  CHECK(contains(refused(cloud, {.nodes = 50, .lambda_fine = -1}, Cause::usage), "lambda_fine"));
  CHECK(contains(refused(cloud, {.nodes = 50, .eps_fine = 0.5}, Cause::usage), "eps_fine"));
}
