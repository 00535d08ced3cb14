// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "types.h"

namespace scanworld {

// The Morton order of cells from -2^15 to 2^15 - 1 along each axis: the bits of x, y and z in turn,
// x lowest.
constexpr std::uint64_t kMortonAxis = 0x249249249249;  // every third bit

// The 16 bits of one coordinate, counted from -2^15, as every third bit.
constexpr std::uint64_t spread_bits(int coordinate) {
  auto x = static_cast<std::uint64_t>(coordinate + (1 << 15)) & 0xffff;
  x = (x | x << 32) & 0xffff00000000ffff;
  x = (x | x << 16) & 0x00ff0000ff0000ff;
  x = (x | x << 8) & 0xf00f00f00f00f00f;
  x = (x | x << 4) & 0x30c30c30c30c30c3;
  return (x | x << 2) & kMortonAxis;
}

constexpr int gathered_bits(std::uint64_t x) {
  x &= kMortonAxis;
  x = (x | x >> 2) & 0x30c30c30c30c30c3;
  x = (x | x >> 4) & 0xf00f00f00f00f00f;
  x = (x | x >> 8) & 0x00ff0000ff0000ff;
  x = (x | x >> 16) & 0xffff00000000ffff;
  x = (x | x >> 32) & 0xffff;
  return static_cast<int>(x) - (1 << 15);
}

// The cell with edges of this length [m] that a point is in.
inline Eigen::Vector3i cell_of(const Vec3& p, double edge) {
  return (p / edge).array().floor().cast<int>();
}

constexpr int kFarthestCell = (1 << 15) - 2;  // of those that have a Morton code, a margin aside

// Whether the cell that a point is in has a Morton code.
inline bool has_code(const Vec3& p, double edge) {
  return p.cwiseAbs().maxCoeff() < kFarthestCell * edge;
}

inline std::uint64_t morton_of(const Eigen::Vector3i& cell) {
  return spread_bits(cell.x()) | spread_bits(cell.y()) << 1 | spread_bits(cell.z()) << 2;
}

inline Eigen::Vector3i cell_at(std::uint64_t morton) {
  return {gathered_bits(morton), gathered_bits(morton >> 1), gathered_bits(morton >> 2)};
}

inline Vec3 middle_of_cell(std::uint64_t morton, double edge) {
  return (cell_at(morton).cast<double>() + Vec3::Constant(0.5)) * edge;
}

// Calls body(morton) for the cells on the way from a place, in units of cells, to the middle of the
// cell `to`, which is left out, until it returns false (Amanatides and Woo 1987).
template <typename Body>
void walk_cells(const Vec3& from, const Eigen::Vector3i& to, const Body& body) {
  const Eigen::Vector3i start = from.array().floor().cast<int>();
  const Vec3 way = to.cast<double>() + Vec3::Constant(0.5) - from;
  std::array<std::uint64_t, 3> bits{};   // of the cell along each axis, in their place
  std::array<int, 3> left{};             // steps along each axis
  std::array<double, 3> next{}, step{};  // of the way, to the next cell along each axis
  int steps = 0;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    bits[axis] = spread_bits(start[k]) << k;
    left[axis] = std::abs(to[k] - start[k]);
    steps += left[axis];
    if (left[axis] == 0) {
      next[axis] = 2;  // beyond the end
      continue;
    }
    step[axis] = 1 / std::abs(way[k]);
    next[axis] = (way[k] > 0 ? start[k] + 1 - from[k] : from[k] - start[k]) * step[axis];
  }
  for (; steps > 0; --steps) {
    if (!body(bits[0] | bits[1] | bits[2])) return;
    std::size_t axis = next[0] <= next[1] ? 0 : 1;
    if (next[2] < next[axis]) axis = 2;
    const std::uint64_t one = std::uint64_t{1} << axis, mask = kMortonAxis << axis;
    // The bits of the other axes carry over, or lend.
    bits[axis] =
        (to[static_cast<int>(axis)] > start[static_cast<int>(axis)] ? (bits[axis] | ~mask) + one
                                                                    : bits[axis] - one) &
        mask;
    next[axis] = --left[axis] > 0 ? next[axis] + step[axis] : 2;
  }
}

}  // namespace scanworld
