// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What `view` and `build --view` share.
#pragma once

#include <filesystem>
#include <string>

#include "viewer/page.h"

namespace scanworld::cli {

inline constexpr std::size_t kPagePoints = 200000;  // of a scan, about

// The name of a folder, which need not exist; also of one that is written "office/" or ".".
std::string folder_name(const std::filesystem::path& folder);

// A scan as a page shows it beside its world.
ScanView scan_view(const World& world, const PointCloud& scan, std::size_t points = kPagePoints);

}  // namespace scanworld::cli
