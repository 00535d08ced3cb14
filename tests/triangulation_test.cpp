// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "thesis/triangulation.h"

#include "support/support.h"
#include "thesis/hull.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::thesis;

namespace {

double area_of(const std::vector<Vec3>& polygon, const Vec3& normal) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]).dot(normal) / 2;
  return sum;
}

void check_triangulation(const std::vector<Vec3>& polygon, const Vec3& normal, bool delaunay) {
  const auto triangles = triangulate_convex(polygon, normal);
  CHECK(triangles.size() == polygon.size() - 2);
  double sum = 0;
  for (const auto& t : triangles) {
    const auto at = [&](std::size_t k) { return polygon[static_cast<std::size_t>(t[k])]; };
    const double area = (at(1) - at(0)).cross(at(2) - at(0)).dot(normal) / 2;
    CHECK(area > -1e-12);
    sum += area;
    if (!delaunay) continue;
    // The circle around the triangle, by its centre in barycentric coordinates.
    const double a = (at(2) - at(1)).squaredNorm(), b = (at(2) - at(0)).squaredNorm(),
                 c = (at(1) - at(0)).squaredNorm();
    const Vec3 weights(a * (b + c - a), b * (c + a - b), c * (a + b - c));
    const Vec3 center =
        (weights[0] * at(0) + weights[1] * at(1) + weights[2] * at(2)) / weights.sum();
    for (const Vec3& p : polygon) CHECK((p - center).norm() > (at(0) - center).norm() * (1 - 1e-6));
  }
  CHECK(sum == doctest::Approx(area_of(polygon, normal)));
}

}  // namespace

TEST_CASE(
    "a convex polygon is triangulated with its area kept and no vertex inside a triangle's "
    "circle") {
  Random random(1);
  for (int round = 0; round < 300; ++round) {
    const Vec3 normal = random.direction();
    const PlaneFrame frame = frame_of({normal, 1});
    std::vector<Vec3> points;
    for (int i = 0; i < random.whole(3, 40); ++i)
      points.push_back(frame.to_space(Vec2(3 * random.gauss(), random.gauss())));
    const auto hull = convex_hull(points, normal);
    if (hull.size() >= 3) check_triangulation(hull, normal, true);
  }
}

TEST_CASE("vertices on one circle and on one line end, with the area kept") {
  for (int n : {3, 4, 5, 8, 33}) {
    std::vector<Vec3> circle;
    for (int i = 0; i < n; ++i)
      circle.emplace_back(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n), 0);
    check_triangulation(circle, Vec3::UnitZ(), true);
  }
  std::vector<Vec3> square;
  for (int i = 0; i < 5; ++i) square.emplace_back(i, 0, 0);
  for (int i = 0; i < 5; ++i) square.emplace_back(5, i, 0);
  for (int i = 0; i < 5; ++i) square.emplace_back(5 - i, 5, 0);
  for (int i = 0; i < 5; ++i) square.emplace_back(0, 5 - i, 0);
  check_triangulation(square, Vec3::UnitZ(), false);
  CHECK(triangulate_convex({{0, 0, 0}, {1, 0, 0}}, Vec3::UnitZ()).empty());
}
