// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

namespace scanworld {

// The finalizer of SplitMix64 (Steele, Lea, Flood 2014): spreads every bit over all.
inline std::uint64_t mix(std::uint64_t x) {
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9;
  x = (x ^ x >> 27) * 0x94d049bb133111eb;
  return x ^ x >> 31;
}

// The hash of a place: equal for equal coordinates.
inline std::uint64_t hash_of_place(float x, float y, float z) {
  const auto bits = [](float v) -> std::uint64_t {
    return std::bit_cast<std::uint32_t>(v + 0.0f);  // makes -0 a 0
  };
  return mix(mix(bits(x) << 32 | bits(y)) ^ (bits(z) + 1));
}

}  // namespace scanworld
