// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "thesis/thesis.h"
#include "world/world.h"

namespace scanworld {

// The class of the thesis (its section 9.1): a small face over the free functions, for a first
// look.
//
//   Reconstruction recon;
//   recon.load_points("with_floor3.txt");
//   double delta = recon.filter_points(100, 10);
//   recon.save_points("filtered.txt");
class Reconstruction {
 public:
  // Reads the points of a scan file in any format. Throws bad_input.
  void load_points(const std::filesystem::path& path);

  // Replaces the points by the medians of cubes that hold more than `min_points` of them; there are
  // `points_per_dimension` cubes along the longest extent. Returns delta, the edge of a cube [m].
  double filter_points(int points_per_dimension, int min_points);

  // Writes the points, by the file's extension as text or PLY. Throws failure.
  void save_points(const std::filesystem::path& path) const;

  // Makes a world of the points as they were loaded. Throws nothing_found.
  World reconstruct() const;

  const PointCloud& points() const { return points_; }

 private:
  PointCloud loaded_, points_;
  thesis::ThesisOptions options_;
};

}  // namespace scanworld
