// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "network.h"

namespace scanworld::sim {

// Between two faces at an edge, pi is flat.
struct PostProcessingOptions {
  double min_dihedral = 0.785;  // [rad] between two faces (45 degrees): sharper folds are cut open
  double max_corner = 2.356;    // [rad] of a face (135 degrees)
  double min_merge_angle = 2.827;  // [rad] between two edges (162 degrees) that become one
};

// What GSRM does to the network it has learnt: removes bad faces and loose edges, and closes holes
// where a face or two will do. Based on: R. L. M. E. do Rego, A. F. R. Araujo, F. B. de Lima Neto,
// Growing Self-Reconstruction Maps, IEEE Transactions on Neural Networks 21(2), 2010.
void post_process(Network& network, const std::vector<Vec3>& positions,
                  const PostProcessingOptions& options = {});

}  // namespace scanworld::sim
