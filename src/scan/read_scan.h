// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "../types.h"

namespace scanworld {

// Reads a scan of one or more files into one cloud, in the order given. The format of each is
// chosen by its extension (.ply .pcd .xyz .txt .csv .asc .pts, each also .gz), else by its first
// bytes. Attributes that not all of the files have are left out. Throws bad_input naming the file
// and the place.
PointCloud read_scan(const std::vector<std::filesystem::path>& paths);

// The format that read_scan would choose: "ply", "pcd" or "xyz".
std::string scan_format(const std::filesystem::path& path);

// Reads scanner positions, one a line: x y z, or t x y z qx qy qz qw (TUM). Throws bad_input naming
// file and line.
std::vector<Vec3> read_poses(const std::filesystem::path& path);

// A number that stands for the set of points: the same in any order and format. 32 hexadecimal
// digits.
std::string fingerprint(const PointCloud& cloud);

}  // namespace scanworld
