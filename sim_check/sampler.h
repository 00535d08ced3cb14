// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "random.h"

namespace scanworld::sim {

// Draws points all over some triangles of a mesh, as many as they have area. The mesh must outlive
// it.
class Sampler {
 public:
  struct Sample {
    Vec3 point;
    std::size_t triangle;
  };

  // Of those triangles that are taken, and have an area.
  Sampler(const Mesh& mesh, const std::function<bool(std::size_t triangle)>& takes);

  bool empty() const { return area_.empty(); }
  Sample draw(Random& random) const;  // there must be a triangle

 private:
  const Mesh& mesh_;
  std::vector<double> area_;  // [m2] summed up
  std::vector<std::size_t> triangle_;
};

}  // namespace scanworld::sim
