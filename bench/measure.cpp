// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "measure.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <fstream>

#include "error.h"
#include "files.h"
#include "scan/read_scan.h"
#include "world/world_json.h"

namespace scanworld::bench {

namespace {

// A world's scan, and what is true about it.
struct ScannedWorld {
  PointCloud cloud;
  std::vector<std::int32_t> surface;  // of each point
  std::set<std::int32_t> asked_for;
};

bool is_world(const std::filesystem::path& path) {
  return std::filesystem::is_directory(path) || lower_extension(path) == ".json";
}

ScannedWorld scan_world(const std::filesystem::path& path, const VirtualScanOptions& options) {
  const World world = read_world(path);
  VirtualScan scan = virtual_scan(world, options);
  std::set<std::int32_t> asked_for = planes_asked_for(world, scan);
  return {std::move(scan.cloud), std::move(scan.surface), std::move(asked_for)};
}

// Lets peak_memory_mb() begin anew, where Linux allows it; else what came before counts too.
void forget_peak_memory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
}

struct Run {
  PointCloud read;  // where the input is a scan
  ReconstructResult result;
  std::vector<StageReport> stages;  // with reading and, as the last, all
};

// `scanned` is null where the input is to be read.
Run run_once(const std::filesystem::path& input, const PointCloud* scanned,
             const ReconstructOptions& options) {
  Run run;
  Report reading, whole;
  const std::size_t points = scanned ? scanned->points.size() : 1;
  StageLog(whole, {}, 1)
      .run("all", scanned ? "points -> surfaces" : "files -> surfaces", points, [&] {
        if (!scanned)
          run.read = StageLog(reading, {}, 1).run("Reading", "files -> points", points, [&] {
            return read_scan({input});
          });
        run.result = reconstruct(scanned ? *scanned : run.read, options);
        return run.result.world.surfaces.size();
      });
  for (const Report* report : {&reading, &run.result.report, &whole})
    run.stages.insert(run.stages.end(), report->stages.begin(), report->stages.end());
  return run;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The stages of the first run with the median times of all.
std::vector<StageReport> median_stages(const std::vector<std::vector<StageReport>>& runs) {
  std::vector<StageReport> stages = runs.front();
  for (std::size_t s = 0; s < stages.size(); ++s) {
    std::vector<double> wall, cpu;
    for (const auto& run : runs) wall.push_back(run[s].seconds), cpu.push_back(run[s].cpu_seconds);
    stages[s].seconds = median(wall);
    stages[s].cpu_seconds = median(cpu);
  }
  return stages;
}

}  // namespace

Measurement measure(const std::filesystem::path& input, const MeasureOptions& options) {
  Measurement m{.input = input.string()};
  std::optional<ScannedWorld> truth;
  if (is_world(input)) truth = scan_world(input, options.scan);
  forget_peak_memory();
  std::vector<std::vector<StageReport>> runs;
  for (int i = 0; i < options.runs; ++i) {
    const Run run = run_once(input, truth ? &truth->cloud : nullptr, options.reconstruct);
    runs.push_back(run.stages);
    const std::string hash = world_hash(run.result.world);
    if (i > 0 && hash != m.world_hash)
      throw Error(Cause::check_failed, fmt::format("{}: two runs made different worlds, {} and {}",
                                                   m.input, m.world_hash, hash));
    m.world_hash = hash;
    if (i + 1 < options.runs) continue;
    m.peak_memory_mb = peak_memory_mb();
    const PointCloud& cloud = truth ? truth->cloud : run.read;
    m.points = cloud.points.size();
    m.fingerprint = fingerprint(cloud);
    m.scale = run.result.report.scale;
    m.noise = run.result.report.noise;
    m.spacing = run.result.report.spacing;
    if (truth) m.score = score_planes(truth->surface, run.result.labels, truth->asked_for);
  }
  m.stages = median_stages(runs);
  m.all = m.stages.back();
  m.stages.pop_back();
  return m;
}

}  // namespace scanworld::bench
