// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numeric>

namespace scanworld::sim {

namespace {

double wall_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Samples {
  std::vector<double> cpu, wall;
};

Samples take_turn(const Task& task, const RoundOptions& options) {
  Samples samples;
  const Stopwatch turn;
  for (int i = 0; i < options.runs && (i < 2 || turn.wall() < options.seconds); ++i) {
    if (task.prepare) task.prepare();
    const Stopwatch watch;
    task.run();
    const double cpu = watch.cpu(), wall = watch.wall();
    samples.cpu.push_back(cpu / static_cast<double>(task.count));
    samples.wall.push_back(wall / static_cast<double>(task.count));
  }
  return samples;
}

}  // namespace

double quantile_of(std::vector<double> numbers, double share) {
  const auto last = static_cast<double>(numbers.size() - 1);
  const auto at = numbers.begin() + static_cast<std::ptrdiff_t>(std::ceil(share * last));
  std::nth_element(numbers.begin(), at, numbers.end());
  return *at;
}

double median_of(std::vector<double> numbers) {
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  if (numbers.size() % 2 == 1) return *middle;
  return (*std::max_element(numbers.begin(), middle) + *middle) / 2;
}

Stopwatch::Stopwatch() : wall_(wall_now()), cpu_(cpu_now()) {}
double Stopwatch::wall() const { return wall_now() - wall_; }
double Stopwatch::cpu() const { return cpu_now() - cpu_; }

Stats stats_of(const std::vector<double>& samples) {
  if (samples.empty()) return {};
  const auto count = static_cast<double>(samples.size());
  Stats stats;
  stats.samples = samples.size();
  stats.mean = std::accumulate(samples.begin(), samples.end(), 0.0) / count;
  double squares = 0;
  for (double s : samples) squares += (s - stats.mean) * (s - stats.mean);
  stats.deviation = samples.size() > 1 ? std::sqrt(squares / (count - 1)) : 0;
  stats.median = median_of(samples);
  stats.p99 = quantile_of(samples, 0.99);
  stats.min = *std::ranges::min_element(samples);
  return stats;
}

std::vector<Timing> time_in_rounds(const std::vector<Task>& tasks, const RoundOptions& options) {
  const std::size_t count = tasks.size();
  for (const Task& task : tasks)
    take_turn(task, {.runs = options.warm_up, .seconds = 10 * options.seconds});
  std::vector<Samples> all(count);
  std::vector<std::vector<double>> medians(count);  // of each task, in each round
  for (int round = 0; round < options.rounds; ++round)
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = (k + static_cast<std::size_t>(round)) % count;
      const Samples turn = take_turn(tasks[i], options);
      all[i].cpu.insert(all[i].cpu.end(), turn.cpu.begin(), turn.cpu.end());
      all[i].wall.insert(all[i].wall.end(), turn.wall.begin(), turn.wall.end());
      medians[i].push_back(median_of(turn.cpu));
      if (options.tick) options.tick();
    }
  std::vector<Timing> timings(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> ratios;
    for (std::size_t r = 0; r < medians[i].size(); ++r)
      ratios.push_back(medians[0][r] / medians[i][r]);
    timings[i] = {.cpu = stats_of(all[i].cpu),
                  .wall = stats_of(all[i].wall),
                  .ratio = median_of(ratios),
                  .ratio_low = quantile_of(ratios, 0.25),
                  .ratio_high = quantile_of(ratios, 0.75)};
  }
  return timings;
}

}  // namespace scanworld::sim
