// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "types.h"

namespace scanworld {

// What the points of a small square of a surface are off a plane of their own.
struct NoiseSample {
  Vec3 at = Vec3::Zero(), normal = Vec3::UnitZ();
  double noise = 0;          // [m] standard deviation
  double area = 0;           // [m2]
  std::int32_t viewer = -1;  // the viewpoint that most of it was seen from, where that is known
};

// The noise of a scan from place to place: it is along the ray, so that surfaces seen square-on
// show more of it than those at a slant, and may grow with range.
class NoiseMap {
 public:
  NoiseMap() = default;
  // In cells with edges of this length [m]. What a cell has is the median of its samples and of
  // those in the cells around, `most` [m] at most; cells with no more than `least` are left out.
  NoiseMap(std::span<const NoiseSample> samples, double edge, double least, double most);

  // The noise at a place [m]; 0 where it is none above the least.
  double at(const Vec3& p) const { return cells_.empty() ? 0 : find(p); }
  // The most of any place [m].
  double largest() const { return largest_; }
  std::size_t size() const { return cells_.size(); }

 private:
  double find(const Vec3& p) const;

  struct Cell {
    std::uint64_t code;
    double noise;
  };
  double edge_ = 1, largest_ = 0;
  std::vector<Cell> cells_;  // by rising code
};

inline std::size_t count_of(const NoiseMap& map) { return map.size(); }

// Noise as a scanner's range and the incidence of its rays explain it.
struct NoiseAtRange {
  double min_range = 0, max_range = 0;          // [m]
  double min_incidence = 0, max_incidence = 0;  // [rad] of rays off the surface's normal
  double noise = 0;                             // [m] the median over the area
  double area = 0;                              // [m2] of what was looked at
};

// What is told of a scan's noise.
struct NoiseModel {
  double low = 0, middle = 0, high = 0;  // [m] 5, 50 and 95 % of the area have no more
  std::vector<NoiseAtRange> at_range;    // where viewpoints are known
};

NoiseModel describe_noise(std::span<const NoiseSample> samples, std::span<const Vec3> viewpoints);

// By ranges that double, from 1 m, and by incidence in thirds of a right angle; a surface counts as
// seen from its own viewpoint, or where that is not known from the nearest one. None where no
// viewpoints are known.
std::vector<NoiseAtRange> noise_by_range(std::span<const NoiseSample> samples,
                                         std::span<const Vec3> viewpoints);

}  // namespace scanworld
