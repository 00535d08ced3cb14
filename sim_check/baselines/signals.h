// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "types.h"

namespace scanworld::sim {

// The points of a cloud, one after the other, as what a growing network learns from: drawn without
// replacement, and shuffled anew when all were. The stream depends on the points and the seed, not
// on the order that the points are in.
class Signals {
 public:
  // Throws bad_input for a cloud with fewer points than nodes are to learn from it.
  Signals(const PointCloud& cloud, int nodes, std::uint64_t seed);

  Vec3 next();     // relative to the cloud's origin
  void shuffle();  // starts a new pass
  std::size_t size() const { return points_.size(); }
  Box3 box() const;

  // The next points that are all different. Throws bad_input where there are not so many.
  std::vector<Vec3> next_distinct(std::size_t count);

 private:
  std::vector<Vec3f> points_;
  std::uint64_t seed_, pass_ = 0;
  std::size_t next_ = 0;
};

}  // namespace scanworld::sim
