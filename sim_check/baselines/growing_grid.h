// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "progress.h"
#include "types.h"

namespace scanworld::sim {

struct GrowingGridOptions {
  int nodes = 5000;         // the lattice grows until it has so many, and then some of a row
  int lambda = 50;          // signals for each node from one new row or column to the next
  double eps = 0.03;        // share of the way to the signal that the nearest node moves
  double sigma = 2;         // [nodes] width of the bell that others move with, by their distance
  int lambda_fine = 100;    // signals for each node when the lattice is as it stays
  double eps_fine = 0.001;  // what eps decays to in these
  std::uint64_t seed = 1;   // of the order that the points are drawn in
};

// A sheet of r x c nodes in rows and columns that is drawn over the points and grows by a row or a
// column where most points are; with two triangles for each of its (r - 1)(c - 1) cells. It covers
// all gaps. Based on: B. Fritzke, Growing Grid - a self-organizing network with constant
// neighborhood range and adaptation strength, Neural Processing Letters 2(5), 1995. Different from
// it: nodes that would move by less than 1e-3 of what the nearest does, stay. The mesh does not
// depend on the order of the points. Throws usage for options out of range, bad_input for a cloud
// that is too small.
Mesh growing_grid(const PointCloud& cloud, const GrowingGridOptions& options = {},
                  const Progress& progress = {});

}  // namespace scanworld::sim
