// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "clutter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "world/assemble.h"
#include "world/solids.h"

namespace scanworld::test {

namespace {

int count_on(double area, double spacing) { return static_cast<int>(area / (spacing * spacing)); }

constexpr double kPi = std::numbers::pi;

}  // namespace

void add_ball(std::vector<Vec3>& points, const Vec3& center, double radius, double spacing,
              double noise, Random& random) {
  for (int i = count_on(4 * kPi * radius * radius, spacing); i > 0; --i)
    points.push_back(center + (radius + noise * random.gauss()) * random.direction());
}

void add_drum(std::vector<Vec3>& points, const Vec3& center, double radius, double height,
              double spacing, double noise, Random& random, double from, double arc) {
  const auto at = [&](double r, double angle, double z) {
    return Vec3(center + Vec3(r * std::cos(angle), r * std::sin(angle), z));
  };
  arc = std::min(arc, 2 * kPi);
  for (int i = count_on(arc * radius * height, spacing); i > 0; --i)
    points.push_back(at(radius + noise * random.gauss(), from + random.uniform(0, arc),
                        height * random.uniform(-0.5, 0.5)));
  for (int i = count_on(kPi * radius * radius, spacing); i > 0; --i)
    points.push_back(at(radius * std::sqrt(random.uniform()), random.uniform(0, 2 * kPi),
                        height / 2 + noise * random.gauss()));
}

void add_crate(std::vector<Vec3>& points, const Vec3& center, const Vec3& size, double angle,
               double spacing, double noise, Random& random) {
  const Mat3 turn = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis)
    for (double side : {-0.5, 0.5}) {
      if (axis == 2 && side < 0) continue;
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      for (int i = count_on(size[a] * size[b], spacing); i > 0; --i) {
        Vec3 p;
        p[axis] = side * size[axis] + noise * random.gauss();
        p[a] = size[a] * random.uniform(-0.5, 0.5);
        p[b] = size[b] * random.uniform(-0.5, 0.5);
        points.push_back(center + turn * p);
      }
    }
}

World floor_world() {
  FoundSurface floor;
  floor.outer = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}};
  return assemble_world({floor}, {});
}

double outside_of(const Obstacle& obstacle, const Frame& frame, const Vec3& point) {
  const Mesh mesh = mesh_of(obstacle, frame);
  double most = -1e300;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) -> const Vec3& {
      return mesh.vertices[static_cast<std::size_t>(t[k])];
    };
    const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0));
    if (normal.norm() > 1e-12) most = std::max(most, normal.normalized().dot(point - at(0)));
  }
  return most;
}

}  // namespace scanworld::test
