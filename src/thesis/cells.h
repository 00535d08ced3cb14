// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include "../types.h"

namespace scanworld::thesis {

// A half-open cube of a regular grid, with indices in [-kLimit, kLimit).
struct Cell {
  std::int32_t i = 0, j = 0, k = 0;

  static constexpr std::int32_t kLimit = 1 << 20;
};

// The cell that `p` lies in; none where it is more than a million cells away.
inline std::optional<Cell> cell_of(const Vec3& p, const Vec3& origin, double size) {
  const Vec3 at = ((p - origin) / size).array().floor();
  if (!(at.array().abs() < Cell::kLimit).all()) return std::nullopt;
  return Cell{static_cast<std::int32_t>(at.x()), static_cast<std::int32_t>(at.y()),
              static_cast<std::int32_t>(at.z())};
}

// Sorts by `key(item)`, a 64-bit number, by digits of 11 bits from the lowest. Items with equal
// keys keep their order.
template <typename Item, typename Key>
void radix_sort(std::vector<Item>& items, Key key) {
  constexpr int kBits = 11;
  constexpr std::uint64_t kMask = (1u << kBits) - 1;
  std::uint64_t used = 0;  // bits that are not the same in all keys
  for (const Item& item : items) used |= key(item) ^ key(items[0]);
  std::vector<Item> sorted(items.size());
  for (int shift = 0; shift < 64; shift += kBits) {
    if ((used >> shift & kMask) == 0) continue;
    std::array<std::size_t, kMask + 2> first{};
    for (const Item& item : items) ++first[(key(item) >> shift & kMask) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (const Item& item : items) sorted[first[key(item) >> shift & kMask]++] = item;
    items.swap(sorted);
  }
}

}  // namespace scanworld::thesis
