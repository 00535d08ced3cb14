// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "mix.h"
#include "types.h"

namespace scanworld::sim {

// A stream of numbers that is the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(mix(seed)) {}
  std::uint64_t next() { return mix(state_ += 0x9e3779b97f4a7c15); }
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }  // in [0, 1)
  double angle() { return 2 * M_PI * unit(); }
  Vec3 level_direction() {
    const double a = angle();
    return {std::cos(a), std::sin(a), 0};
  }

 private:
  std::uint64_t state_;
};

}  // namespace scanworld::sim
