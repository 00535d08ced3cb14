// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "types.h"

namespace scanworld::sim {

struct TessellateOptions {
  std::size_t triangles = 1000000;  // at least
  double noise = 0.005;             // [m] standard deviation of the vertices, along their normals
  std::uint64_t seed = 1;
};

// A mesh cut into small triangles, neighbours of which still share their edges, and made uneven:
// what the best of surface reconstructions would make of a scan of it, without a hole.
// Throws usage where an option is out of range.
Mesh tessellate(const Mesh& mesh, const TessellateOptions& options = {});

}  // namespace scanworld::sim
