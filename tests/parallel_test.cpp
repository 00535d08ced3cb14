// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "parallel.h"

#include <atomic>
#include <stdexcept>

#include "support/support.h"

using namespace scanworld;

TEST_CASE("parallel_for calls the body once for each index, with any number of threads") {
  for (int threads : {1, 2, 4, 0}) {
    const ThreadLimit limit(threads);
    std::vector<std::atomic<int>> calls(1000);
    parallel_for(calls.size(), [&](std::size_t i) { ++calls[i]; });
    for (const auto& c : calls) CHECK(c == 1);
  }
  parallel_for(0, [](std::size_t) { FAIL("nothing to call"); });
}

TEST_CASE("parallel_for throws the error of the first index that failed") {
  for (int round = 0; round < 20; ++round) {
    std::string message;
    try {
      parallel_for(100, [](std::size_t i) {
        if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
      });
    } catch (const std::runtime_error& e) {
      message = e.what();
    }
    CHECK(message == "7");
  }
}

TEST_CASE("parts cover a range without gap or overlap") {
  for (std::size_t count : {0u, 1u, 9u, 10u, 11u, 100u}) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < part_count(count, 10); ++i) {
      CHECK(part_of(i, count, 10).begin == next);
      next = part_of(i, count, 10).end;
    }
    CHECK(next == count);
  }
}

TEST_CASE("numbers sorted by several threads are those that one sorts") {
  for (std::size_t count : {0u, 1u, 1000u, 32768u, 32769u, 200001u}) {
    std::vector<std::uint64_t> items(count);
    for (std::size_t i = 0; i < count; ++i) items[i] = (i * 2654435761u) % 65537;
    std::vector<std::uint64_t> expected = items;
    std::sort(expected.begin(), expected.end());
    parallel_sort(items);
    CHECK(items == expected);
  }
}
