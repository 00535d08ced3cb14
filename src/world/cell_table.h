// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "../mix.h"
#include "../types.h"

namespace scanworld {

// Some cells of a cubic grid, numbered, for fast look-ups by many points.
class CellTable {
 public:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  // The name of the cell that a point is in. What is farther than 2^20 edges from the origin counts
  // to the last cells there.
  static std::uint64_t key_of(const Vec3& p, double edge) {
    constexpr double kBias = 1 << 20;  // makes all positive, so that casts round down
    std::uint64_t key = 0;
    for (double v : p)
      key =
          key << 21 | static_cast<std::uint64_t>(std::clamp(v / edge + kBias, 0.0, 2 * kBias - 1));
    return key;
  }
  // The middle of the cell of this name.
  static Vec3 middle_of(std::uint64_t key, double edge) {
    constexpr std::int64_t kBias = 1 << 20;
    const auto axis = [&](int shift) {
      const auto cell = static_cast<std::int64_t>(key >> shift & 0x1fffff) - kBias;
      return (static_cast<double>(cell) + 0.5) * edge;
    };
    return {axis(42), axis(21), axis(0)};
  }

  // Cell i is that of keys[i]; the keys are different.
  CellTable(const std::vector<std::uint64_t>& keys, double edge)
      : edge_(edge),
        slots_(std::bit_ceil(2 * keys.size() + 1)),
        filter_(std::bit_ceil(keys.size() / 8 + 1)) {
    for (std::uint32_t i = 0; i < keys.size(); ++i) {
      const std::uint64_t hash = mix(keys[i]);
      std::size_t at = hash;
      while (slots_[at & (slots_.size() - 1)].cell != kNone) ++at;
      slots_[at & (slots_.size() - 1)] = {keys[i], i};
      filter_[word_of(hash)] |= bit_of(hash);
    }
  }

  // The number of the cell that a point is in, or kNone.
  std::uint32_t find(const Vec3& p) const {
    const std::uint64_t key = key_of(p, edge_), hash = mix(key);
    if ((filter_[word_of(hash)] & bit_of(hash)) == 0) return kNone;
    for (std::size_t at = hash;; ++at) {
      const Slot& slot = slots_[at & (slots_.size() - 1)];
      if (slot.cell == kNone || slot.key == key) return slot.cell;
    }
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t cell = kNone;
  };
  std::size_t word_of(std::uint64_t hash) const { return hash >> 38 & (filter_.size() - 1); }
  static std::uint64_t bit_of(std::uint64_t hash) { return std::uint64_t{1} << (hash >> 32 & 63); }

  double edge_;  // [m]
  std::vector<Slot> slots_;
  std::vector<std::uint64_t> filter_;  // some 8 bits a key, small enough for the cache: most points
                                       // are in no cell and are done with here
};

}  // namespace scanworld
