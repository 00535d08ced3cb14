// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Timing on a machine that others use as well: what is compared takes turns, in short rounds, so
// that a slow second slows all of it.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace scanworld::sim {

// The median of numbers, at least one; of an even count the mean of the two in the middle.
double median_of(std::vector<double> numbers);
// The number that a share of all, at least one, are no larger than.
double quantile_of(std::vector<double> numbers, double share);

// Seconds since it was made.
class Stopwatch {
 public:
  Stopwatch();
  double wall() const;
  double cpu() const;  // of this thread

 private:
  double wall_, cpu_;
};

// Of samples, in seconds.
struct Stats {
  double mean = 0, deviation = 0, median = 0, p99 = 0, min = 0;
  std::size_t samples = 0;
};
Stats stats_of(const std::vector<double>& samples);

// What took a time, and how many times as long the first one took.
struct Timing {
  Stats cpu, wall;   // [s] CPU time of the thread, and time on the wall
  double ratio = 1;  // first to this: the median over the rounds, of CPU medians
  double ratio_low = 1, ratio_high = 1;  // quartiles of the rounds'
  bool is_noisy() const { return ratio_high > 1.2 * ratio_low; }
};

// Something to be timed: prepare(), untimed, then run(), which does `count` things of a kind.
struct Task {
  std::function<void()> prepare;  // may be empty
  std::function<void()> run;
  std::size_t count = 1;
};

struct RoundOptions {
  int warm_up = 10;  // runs of each, untimed, before all
  int rounds = 7;
  int runs = 40;  // of each in a round, at most
  double seconds =
      0.5;  // [s] on the wall that a task may take in a round, about; at least two runs
  std::function<void()> tick;  // called after each task's turn
};

// Times tasks in turns, each round beginning with another of them. The result is per thing.
std::vector<Timing> time_in_rounds(const std::vector<Task>& tasks, const RoundOptions& options);

}  // namespace scanworld::sim
