// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "progress.h"
#include "types.h"

namespace scanworld::sim {

struct BaselineOptions {
  int nodes = 5000;        // that a mesh has, about
  std::uint64_t seed = 1;  // of the order that the points are drawn in
};

// A method of others that makes a dense mesh of a scan, in the scan's coordinates.
struct Baseline {
  std::string name;  // "gsrm"
  std::string describes;
  Mesh (*make)(const PointCloud&, const BaselineOptions&, const Progress&);
};

// Growing Grid, GSRM, and growing neural gas: those that the thesis was compared with in 2012, or
// probably was, each with its usual settings.
const std::vector<Baseline>& baselines();

// Throws usage naming those that there are.
const Baseline& baseline_named(const std::string& name);

}  // namespace scanworld::sim
