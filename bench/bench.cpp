// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Times the stages of a reconstruction: scanworld_bench SCAN [RUNS]. Prints the median of each
// stage in milliseconds, of CPU time too, then peak memory and the world's hash, which shows
// whether two builds still make the same world.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "error.h"
#include "reconstruct.h"
#include "scan/read_scan.h"
#include "world/world_json.h"

namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void run(const char* path, int runs) {
  using namespace scanworld;
  std::vector<Report> reports;
  std::string hash;
  for (int i = 0; i < runs; ++i) {
    Report reading;
    const PointCloud cloud =
        StageLog(reading, {}, 1).run("Reading", "files -> points", std::size_t{1}, [&] {
          return read_scan({path});
        });
    ReconstructResult result = reconstruct(cloud);
    result.report.stages.insert(result.report.stages.begin(), reading.stages[0]);
    reports.push_back(result.report);
    hash = world_hash(result.world);
  }
  double total = 0, total_cpu = 0;
  fmt::print("{:<28} {:>10} {:>10} {:>12} {:>12}\n", "stage", "ms", "CPU ms", "in", "out");
  for (std::size_t s = 0; s < reports[0].stages.size(); ++s) {
    std::vector<double> wall, cpu;
    for (const Report& report : reports)
      wall.push_back(report.stages[s].seconds), cpu.push_back(report.stages[s].cpu_seconds);
    const StageReport& stage = reports[0].stages[s];
    fmt::print("{:<28} {:>10.2f} {:>10.2f} {:>12} {:>12}\n", stage.name, 1e3 * median(wall),
               1e3 * median(cpu), stage.in, stage.out);
    total += median(wall), total_cpu += median(cpu);
  }
  fmt::print("{:<28} {:>10.2f} {:>10.2f}\npeak memory {:.0f} MB, world hash {}\n", "all",
             1e3 * total, 1e3 * total_cpu, peak_memory_mb(), hash);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: scanworld_bench SCAN [RUNS]\n");
    return 2;
  }
  try {
    run(argv[1], argc > 2 ? std::max(1, std::atoi(argv[2])) : 5);
    return 0;
  } catch (const scanworld::Error& e) {
    fmt::print(stderr, "scanworld_bench: {}\n", e.what());
    return static_cast<int>(e.cause);
  }
}
