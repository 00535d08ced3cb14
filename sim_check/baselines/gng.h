// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gas.h"

namespace scanworld::sim {

struct GngOptions {
  GasOptions gas;
  bool two_faces_an_edge = true;  // else each three nodes that are connected become a triangle
};

// Growing neural gas (Fritzke 1995), with a triangle for each clique of three nodes, some of which
// cannot have one where no edge may have more than two. The gas makes no faces itself: it is the
// plainest way from one to a surface. Triangles are not oriented. The mesh does not depend on the
// order of the points. Throws usage for options out of range, bad_input for a cloud that is too
// small.
Mesh gng_with_cliques(const PointCloud& cloud, const GngOptions& options = {},
                      const Progress& progress = {});

}  // namespace scanworld::sim
