// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What `build` and `check` share about a scan, its poses and how true a world is to it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "world/fidelity.h"

namespace scanworld::cli {

// Of --poses.
inline constexpr const char* kPosesHelp =
    "Scanner positions, one a line: x y z, or t x y z qx qy qz qw; a property scan_index of the "
    "scan's points counts them from 0";

// Reads a scan, and gives it the scanner positions of a file where its name is not empty.
PointCloud read_scan_with_poses(const std::vector<std::filesystem::path>& scans,
                                const std::filesystem::path& poses);

// Measures a world against its scan, whose noise and spacing are found as the world's own options
// say, so that `check` finds what `build` found. Looks at about so many points.
Fidelity fidelity_of(const World& world, const PointCloud& cloud,
                     std::size_t points = FidelityOptions{}.points);

// Shares, lengths in metres; null for what was not measured.
nlohmann::ordered_json json_of(const Fidelity& fidelity);

// The figures, the surfaces farthest from their points, each criterion, and the verdict.
std::string text_of(const Fidelity& fidelity, const World& world);

// "faithful", or "not faithful: " and the criteria that are not met.
std::string verdict_of(const Fidelity& fidelity);

}  // namespace scanworld::cli
