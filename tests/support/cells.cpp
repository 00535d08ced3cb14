// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "cells.h"

#include <set>

#include "space/check_complex.h"

namespace scanworld::test {

using space::CellComplex;

int split_all(CellComplex& complex, const Plane& plane) {
  const int index = complex.add_plane(plane).plane;
  int splits = 0;
  for (int c = static_cast<int>(complex.cells().size()) - 1; c >= 0; --c)
    splits += complex.split(c, index);
  return splits;
}

void check(const CellComplex& complex) {
  for (const std::string& fault : check_complex(complex)) FAIL_CHECK(fault);
}

Vec3 random_place(Random& random, const Box3& box) {
  Vec3 p;
  for (int k = 0; k < 3; ++k) p[k] = random.uniform(box.min()[k], box.max()[k]);
  return p;
}

std::vector<Vec3> random_rectangle(Random& random, const Vec3& middle, const Vec3& normal,
                                   double size) {
  const PlaneFrame frame = frame_of(plane_through(middle, normal), middle);
  const double turn = random.uniform(0, M_PI), wide = random.uniform(0.2, 1) * size;
  const Vec3 u = size * (std::cos(turn) * frame.u + std::sin(turn) * frame.v);
  const Vec3 v = wide * (std::cos(turn) * frame.v - std::sin(turn) * frame.u);
  return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
}

double area_of(const std::vector<Vec3>& polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return sum.norm() / 2;
}

CellComplex random_complex(std::uint64_t seed, const Box3& box, int planes) {
  Random random(seed);
  CellComplex complex(box);
  for (int k = 0; k < planes; ++k) {
    Vec3 normal = random.direction();
    if (k % 3 == 0) normal = Vec3::Unit(random.whole(0, 2));
    if (k % 3 == 1) normal = Vec3(normal.x(), normal.y(), 0).normalized();
    Vec3 middle = random_place(random, box);
    if (k % 4 == 0) middle = (middle / 0.5).array().round() * 0.5;
    const auto patch =
        random_rectangle(random, middle, normal, box.diagonal().norm() * random.uniform(0, 0.3));
    const int plane = complex.add_plane(plane_through(middle, normal)).plane;
    std::set<int> touched;
    complex.clip(patch, [&](int cell, const std::vector<Vec3>&) { touched.insert(cell); });
    for (const int cell : touched) complex.split(cell, plane);
  }
  return complex;
}

}  // namespace scanworld::test
