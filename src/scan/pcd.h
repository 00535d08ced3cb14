// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "rows.h"

namespace scanworld {

// Reads a PCD file (Point Cloud Library): ascii (gzip too), binary or binary_compressed, fields of
// any type and count, with normals and packed colours where they are there. VIEWPOINT becomes the
// cloud's viewpoint where it says something: it is not the default one, or the cloud is organised
// and so was seen from one place. An organised cloud is recognised as a camera's image by its
// pixels lying on the rays of a pinhole. Throws bad_input naming the file and the line or byte.
RowSource open_pcd(const std::filesystem::path& path);

}  // namespace scanworld
