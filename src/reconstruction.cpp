// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruction.h"

#include "reconstruct.h"
#include "scan/read_scan.h"
#include "scan/write_scan.h"

namespace scanworld {

void Reconstruction::load_points(const std::filesystem::path& path) {
  loaded_ = points_ = read_scan({path});
  options_ = {};
}

double Reconstruction::filter_points(int points_per_dimension, int min_points) {
  options_.filter.points_per_dimension = points_per_dimension;
  options_.filter.min_points = min_points;
  const thesis::FilteredPoints filtered = thesis::filter_points(points_, options_.filter);
  PointCloud medians{.origin = points_.origin,
                     .viewpoints = points_.viewpoints,
                     .camera_frame = points_.camera_frame};
  for (const Vec3& p : filtered.points) medians.points.push_back(p.cast<float>());
  points_ = std::move(medians);
  return filtered.delta;
}

void Reconstruction::save_points(const std::filesystem::path& path) const {
  write_scan(path, points_);
}

World Reconstruction::reconstruct() const {
  return scanworld::reconstruct(loaded_, {.method = Method::thesis, .thesis = options_}).world;
}

}  // namespace scanworld
