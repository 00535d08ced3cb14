// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "cell_walk.h"

namespace scanworld {

// Some cells by their Morton codes (cell_walk.h), as bits of their blocks.
class CellSet {
 public:
  static constexpr int kBlockBits = 9;  // of a cell's Morton code, within its block
  static constexpr std::size_t kBlockCells = 1 << kBlockBits;

  struct Block {
    std::uint64_t key;
    std::array<std::uint64_t, kBlockCells / 64> bits{};
  };

  void insert(std::uint64_t code) {
    Block& block = block_of(code >> kBlockBits);
    const std::uint64_t cell = code & (kBlockCells - 1);
    block.bits[cell / 64] |= std::uint64_t{1} << cell % 64;
  }
  const Block* find(std::uint64_t key) const {
    const auto found = index_.find(key);
    return found == index_.end() ? nullptr : &blocks_[found->second];
  }
  static bool contains(const Block& block, std::uint64_t code) {
    const std::uint64_t cell = code & (kBlockCells - 1);
    return (block.bits[cell / 64] >> cell % 64 & 1) != 0;
  }
  bool contains(std::uint64_t code) const {
    const Block* block = find(code >> kBlockBits);
    return block && contains(*block, code);
  }
  // Whether the cell with edges of this length [m] that a place is in is one of these.
  bool contains(const Vec3& place, double edge) const {
    return has_code(place, edge) && contains(morton_of(cell_of(place, edge)));
  }
  // Asks for cells that are near each other one after the other: most lie in the block of the last.
  class Reader {
   public:
    explicit Reader(const CellSet& cells) : cells_(cells) {}
    bool contains(std::uint64_t code) {
      if (const std::uint64_t key = code >> kBlockBits; key != key_)
        key_ = key, block_ = cells_.find(key);
      return block_ && CellSet::contains(*block_, code);
    }

   private:
    const CellSet& cells_;
    const Block* block_ = nullptr;
    std::uint64_t key_ = ~std::uint64_t{0};  // of no block
  };

  void insert(const CellSet& more) {
    for (const Block& from : more.blocks_) {
      Block& to = block_of(from.key);
      for (std::size_t w = 0; w < to.bits.size(); ++w) to.bits[w] |= from.bits[w];
    }
  }
  // All, by ascending code.
  std::vector<std::uint64_t> codes() const {
    std::vector<std::uint64_t> all;
    for (const Block& block : blocks_)
      for (std::size_t w = 0; w < block.bits.size(); ++w)
        for (std::uint64_t left = block.bits[w]; left != 0; left &= left - 1)
          all.push_back(block.key << kBlockBits |
                        (64 * w + static_cast<std::size_t>(std::countr_zero(left))));
    std::sort(all.begin(), all.end());
    return all;
  }
  std::vector<Block> take_blocks() { return std::move(blocks_); }

 private:
  Block& block_of(std::uint64_t key) {
    if (blocks_.empty() || blocks_[last_].key != key) {
      const auto [found, is_new] = index_.try_emplace(key, blocks_.size());
      if (is_new) blocks_.push_back({.key = key});
      last_ = found->second;
    }
    return blocks_[last_];
  }

  std::vector<Block> blocks_;
  std::unordered_map<std::uint64_t, std::size_t> index_;
  std::size_t last_ = 0;
};

}  // namespace scanworld
