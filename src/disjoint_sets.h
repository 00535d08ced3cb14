// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace scanworld {

// Numbers in sets, each named by the lowest of its own (Tarjan 1975, with path halving).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  std::uint32_t find(std::size_t item) {
    auto i = static_cast<std::uint32_t>(item);
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  bool are_joined(std::size_t a, std::size_t b) {
    return parent_[a] == parent_[b] || find(a) == find(b);
  }
  void unite(std::size_t a, std::size_t b) {
    const std::uint32_t p = find(a), q = find(b);
    parent_[std::max(p, q)] = std::min(p, q);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace scanworld
