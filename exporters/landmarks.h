// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// Writes the landmark map as YAML: an entry a landmark with id, kind, relief, position (of an edge
// foot and top), ids of its surfaces, and where it is known its covariance [m2], the upper triangle
// xx xy xz yy yz zz, with the 1-sigma [m] along each axis.
void write_landmarks_yaml(const std::filesystem::path& path, const World& world,
                          const ExportOptions& options);

// The same as CSV, a line a landmark; what is not known is empty.
void write_landmarks_csv(const std::filesystem::path& path, const World& world,
                         const ExportOptions& options);

}  // namespace scanworld
