// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sim_check/timing.h"

#include <numeric>

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::sim;
using namespace scanworld::test;

TEST_CASE("the figures of samples are those of their definitions") {
  std::vector<double> samples(101);
  std::iota(samples.begin(), samples.end(), 0);
  Random random(1);
  shuffle(samples, random);
  const Stats stats = stats_of(samples);
  CHECK(stats.mean == doctest::Approx(50));
  CHECK(stats.median == 50);
  CHECK(stats.p99 == 99);
  CHECK(stats.min == 0);
  CHECK(stats.deviation == doctest::Approx(29.3).epsilon(0.01));
  CHECK(median_of({4, 1, 3, 2}) == 2.5);
  CHECK(stats_of({}).samples == 0);
}

TEST_CASE("tasks take turns, each round beginning with the next") {
  std::string order;
  const auto task = [&](char name) { return Task{.run = [&order, name] { order += name; }}; };
  const auto timings = time_in_rounds({task('a'), task('b'), task('c')},
                                      {.warm_up = 1, .rounds = 3, .runs = 2, .seconds = 10});
  CHECK(order ==
        "abc"
        "aabbcc"
        "bbccaa"
        "ccaabb");
  REQUIRE(timings.size() == 3);
  CHECK(timings[1].cpu.samples == 6);
}

TEST_CASE("a task that does four times as much is found to") {
  volatile double sink = 0;
  const auto work = [&](int times) {
    return Task{.run = [&sink, times] {
      for (int i = 0; i < times * 20000; ++i) sink = sink + 1.0 / (i + 1);
    }};
  };
  const auto timings = time_in_rounds({work(4), work(1)}, {.rounds = 9, .runs = 10, .seconds = 10});
  CHECK(timings[0].ratio == 1);
  CHECK(timings[1].ratio > 2.5);
  CHECK(timings[1].ratio < 6);
  CHECK(timings[1].ratio_low <= timings[1].ratio);
  CHECK(timings[1].ratio_high >= timings[1].ratio);
}
