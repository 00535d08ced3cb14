// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "progress.h"

namespace scanworld {

// What one stage did.
struct StageReport {
  std::string name;
  double seconds = 0;      // on the wall
  double cpu_seconds = 0;  // of all threads
  std::size_t in = 0, out = 0;
  std::string what;  // it takes and gives: "points -> medians"
};

// What was found on the way from a scan to a world.
struct Report {
  std::vector<StageReport> stages;
  double scale = 0;  // [m] the length that the method measured in
  double noise = 0;  // [m] median over the surfaces of their points' distances from them (rms)
  std::vector<std::string> warnings;
};

// Process CPU time of all threads [s].
double cpu_seconds();

// Runs stages one after the other, telling a progress function, and notes time and counts of each.
class StageLog {
 public:
  StageLog(Report& report, const Progress& progress, std::size_t stages)
      : report_(report), progress_(progress), stages_(stages) {}

  // Runs `body` and returns what it returns; `count` says how much that is.
  template <typename Body, typename Count>
  auto run(std::string_view name, std::string_view what, std::size_t in, Body body, Count count) {
    if (progress_)
      progress_(name, static_cast<double>(report_.stages.size()) / static_cast<double>(stages_));
    const auto start = std::chrono::steady_clock::now();
    const double cpu = cpu_seconds();
    auto result = body();
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    report_.stages.push_back(
        {std::string(name), seconds, cpu_seconds() - cpu, in, count(result), std::string(what)});
    return result;
  }
  template <typename Body>
  auto run(std::string_view name, std::string_view what, std::size_t in, Body body) {
    return run(name, what, in, body, [](const auto& result) { return result.size(); });
  }

 private:
  Report& report_;
  const Progress& progress_;
  const std::size_t stages_;
};

}  // namespace scanworld
