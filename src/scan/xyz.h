// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "rows.h"

namespace scanworld {

// Reads a text of points, one a line (XYZ, TXT, CSV, ASC, PTS; gzip too). Which column is what is
// told by a line of names (also in a comment, as CloudCompare writes it), else by count and values:
// three coordinates, then intensity, colour as whole numbers from 0 to 255, or unit normals. Lines
// of one whole number announce a count of points (PTS); fewer points than that are an error. Throws
// bad_input naming file, line and word.
RowSource open_xyz(const std::filesystem::path& path);

}  // namespace scanworld
