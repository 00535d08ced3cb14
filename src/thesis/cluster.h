// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "plane_fit.h"

namespace scanworld::thesis {

// Points, by index into the filtered ones, that lie in one plane. In the end each cluster is one
// wall.
struct Cluster {
  std::vector<int> members;
  PlaneFit fit;
};

}  // namespace scanworld::thesis
