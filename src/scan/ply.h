// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "rows.h"

namespace scanworld {

// Reads the vertices of a PLY file: ascii (gzip too) or binary of either byte order, numbers of any
// type, with normals and colours where they are there; other properties and elements are passed
// over. Throws bad_input naming the file and the line or byte.
RowSource open_ply(const std::filesystem::path& path);

// True where the file is a PLY file with faces, so a mesh rather than a scan.
bool is_ply_mesh(const std::filesystem::path& path);

}  // namespace scanworld
