// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "noise_map.h"
#include "progress.h"
#include "types.h"

namespace scanworld {

// What one stage did.
struct StageReport {
  std::string name;
  double seconds = 0;         // on the wall
  double cpu_seconds = 0;     // of all threads
  double peak_memory_mb = 0;  // of the process, up to the end of the stage
  std::size_t in = 0, out = 0;
  std::string what;  // it takes and gives: "points -> medians"
};

// What was found on the way from a scan to a world.
struct Report {
  std::vector<StageReport> stages;
  std::size_t duplicates = 0;  // points at the very place of another, which count for nothing
  double scale = 0;            // [m] the length that the method measured in
  // [m] of the points off their surfaces, as estimated and used; the median of the surfaces' rms
  // where the method uses none.
  double noise = 0;
  NoiseModel noise_model;  // what it is from place to place
  double flatness = 0;     // [m] how far surfaces are off planes of 1 m by themselves, rms
  double drift = 0;        // [m] between the layers of surfaces that the scan shows more than once
  double spacing = 0;      // [m] between neighbouring points, where the method looks at it
  std::vector<double> plane_noise;  // [m] of each surface's points, where the method tells it
  std::vector<std::string> warnings;
};

// CPU time of all threads of this process so far [s].
double cpu_seconds();

// The most memory that this process has held [MB].
double peak_memory_mb();

// How many things a value holds, as a report counts them. Other types bring a function of this name
// in their own namespace.
inline std::size_t count_of(std::size_t count) { return count; }
inline std::size_t count_of(const PointCloud& cloud) { return cloud.points.size(); }
template <typename T>
std::size_t count_of(const std::vector<T>& items) {
  return items.size();
}
template <typename T>
std::size_t count_of(const std::vector<std::vector<T>>& lists) {
  std::size_t count = 0;
  for (const auto& list : lists) count += list.size();
  return count;
}

// Runs stages one after the other, telling a progress function, and notes time and counts of each.
class StageLog {
 public:
  StageLog(Report& report, const Progress& progress, std::size_t stages)
      : report_(report), progress_(progress), stages_(stages) {}

  // Runs `body` on what `in` counts and returns what it returns. `what` says what is counted.
  template <typename In, typename Body>
  auto run(std::string_view name, std::string_view what, const In& in, Body body) {
    if (progress_)
      progress_(name, static_cast<double>(report_.stages.size()) / static_cast<double>(stages_));
    const std::size_t count_in = count_of(in);
    const auto start = std::chrono::steady_clock::now();
    const double cpu = cpu_seconds();
    auto result = body();
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    report_.stages.push_back({std::string(name), wall.count(), cpu_seconds() - cpu,
                              peak_memory_mb(), count_in, count_of(result), std::string(what)});
    return result;
  }

 private:
  Report& report_;
  const Progress& progress_;
  const std::size_t stages_;
};

}  // namespace scanworld
