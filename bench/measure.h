// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reconstruct.h"
#include "score.h"
#include "world/virtual_scan.h"

namespace scanworld::bench {

struct MeasureOptions {
  ReconstructOptions reconstruct;
  VirtualScanOptions scan;  // of worlds
  int runs = 5;
};

// What making a world of one place took and gave.
struct Measurement {
  std::string input;
  std::size_t points = 0;
  std::string fingerprint;          // of the points, as two builds may scan a world differently
  std::vector<StageReport> stages;  // times are the medians of the runs
  StageReport all;                  // with what is between the stages
  double scale = 0, noise = 0, spacing = 0;  // [m] found
  double peak_memory_mb = 0;                 // since the input was there
  std::string world_hash;
  std::optional<PlaneScore> score;  // of a world, which is the truth about its scan
};

// Makes a world of a scan, which each run reads anew, or of what the virtual scanner sees of a
// world (a .json file or a folder). Throws check_failed where two runs make different worlds.
Measurement measure(const std::filesystem::path& input, const MeasureOptions& options);

}  // namespace scanworld::bench
