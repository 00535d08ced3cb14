// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace scanworld {

// Calls body(i) once for each i in [0, count), in any order, on any thread. Each call writes what
// belongs to its own i alone; sums are made afterwards, in the order of i, so that threads cannot
// change a result. The exception of the smallest i that threw is thrown again.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

// A range [begin, end) of items, one of the parts that a large array is worked on in.
struct Part {
  std::size_t begin, end;
};

// How many points of a cloud are one such part, usually.
constexpr std::size_t kPointsPerPart = 1 << 16;

// Splits [0, count) into parts of `size` items (the last one smaller), whatever the number of
// threads.
inline std::size_t part_count(std::size_t count, std::size_t size) {
  return (count + size - 1) / size;
}
inline Part part_of(std::size_t i, std::size_t count, std::size_t size) {
  return {i * size, (i + 1) * size < count ? (i + 1) * size : count};
}

// Sorts numbers: parts of them by several threads, which are then merged two by two.
template <typename T>
void parallel_sort(std::vector<T>& items) {
  constexpr std::size_t kPart = 1 << 15;
  const auto at = [&](std::size_t i) {
    return items.begin() + static_cast<std::ptrdiff_t>(std::min(i, items.size()));
  };
  parallel_for(part_count(items.size(), kPart),
               [&](std::size_t i) { std::sort(at(i * kPart), at((i + 1) * kPart)); });
  for (std::size_t size = kPart; size < items.size(); size *= 2)
    parallel_for(part_count(items.size(), 2 * size), [&](std::size_t i) {
      std::inplace_merge(at(2 * i * size), at((2 * i + 1) * size), at((2 * i + 2) * size));
    });
}

// Lets at most `threads` threads work (0 = all) while it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scanworld
