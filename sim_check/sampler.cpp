// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sampler.h"

#include <algorithm>

#include "world/solids.h"

namespace scanworld::sim {

Sampler::Sampler(const Mesh& mesh, const std::function<bool(std::size_t)>& takes) : mesh_(mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const double area = vector_area(mesh, i).norm();
    if (area <= 0 || !takes(i)) continue;
    sum += area;
    area_.push_back(sum), triangle_.push_back(i);
  }
}

Sampler::Sample Sampler::draw(Random& random) const {
  const double at = random.unit() * area_.back();
  const auto found = static_cast<std::size_t>(std::ranges::upper_bound(area_, at) - area_.begin());
  const std::size_t i = triangle_[std::min(found, triangle_.size() - 1)];
  double u = random.unit(), v = random.unit();
  if (u + v > 1) u = 1 - u, v = 1 - v;
  const auto& t = mesh_.triangles[i];
  const Vec3 &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
  return {a + u * (b - a) + v * (c - a), i};
}

}  // namespace scanworld::sim
