// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "../types.h"

namespace scanworld {

// A column of whole numbers written beside the coordinates.
struct ExtraColumn {
  std::string name;
  std::vector<std::int32_t> values;  // one for each point
};

// The column that counts the poses that points were seen from.
inline constexpr const char* kScanIndex = "scan_index";

// Writes a scan as PLY (binary, little-endian; coordinates as float, or double where the cloud has
// an origin) or as XYZ text (extension .xyz or .txt), with normals, colours and viewers (as
// scan_index) where the cloud has them. Throws failure where the file cannot be written, usage
// where the extension is another.
void write_scan(const std::filesystem::path& path, const PointCloud& cloud,
                const std::vector<ExtraColumn>& extra = {});

// Writes one row for each point of the input, in its order, with its surface's id (-1 = none);
// points that were left out for not being finite get NaN coordinates and -1. `labels`: one for each
// point of the cloud.
void write_labels(const std::filesystem::path& path, const PointCloud& cloud,
                  const std::vector<std::int32_t>& labels);

}  // namespace scanworld
