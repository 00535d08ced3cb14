// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gas.h"
#include "post_processing.h"

namespace scanworld::sim {

struct GsrmOptions {
  GasOptions gas;
  PostProcessingOptions post;
};

// Growing self-reconstruction maps: a growing neural gas that makes faces between the two nodes
// nearest to a point and the neighbours they share. Based on: R. L. M. E. do Rego, A. F. R. Araujo,
// F. B. de Lima Neto, Growing Self-Reconstruction Maps, IEEE Transactions on Neural Networks 21(2),
// 2010. Triangles are not oriented; no edge has more than two. The mesh does not depend on the
// order of the points. Throws usage for options out of range, bad_input for a cloud that is too
// small.
Mesh gsrm(const PointCloud& cloud, const GsrmOptions& options = {}, const Progress& progress = {});

}  // namespace scanworld::sim
