// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "../types.h"

namespace scanworld {

// Reads a scan of one or more files into one cloud, in the order given. The format of each is
// chosen by its extension (.ply .pcd .xyz .txt .csv .asc .pts, each also .gz), else by its first
// bytes. Attributes that not all of the files have are left out. `poses` are scanner positions in
// the coordinates of the files, in place of those that files tell: of which the column scan_index
// then tells a point's own, see assemble_cloud(). Throws bad_input naming the file and the place.
PointCloud read_scan(const std::vector<std::filesystem::path>& paths,
                     const std::vector<Vec3>& poses = {});

// Whether a scan has a scan_index for each point, which tells its viewpoint once there are poses.
bool has_scan_index(const std::filesystem::path& path);

// The format that read_scan would choose: "ply", "pcd" or "xyz".
std::string scan_format(const std::filesystem::path& path);

// Reads scanner positions, one a line: x y z, or t x y z qx qy qz qw (TUM). Throws bad_input naming
// file and line.
std::vector<Vec3> read_poses(const std::filesystem::path& path);

// A number that stands for the set of points: the same in any order and format. 32 hexadecimal
// digits.
std::string fingerprint(const PointCloud& cloud);

}  // namespace scanworld
