// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "../types.h"

namespace scanworld::rival {

struct ScaleOptions {
  double noise = 0;    // [m] standard deviation of the points off their surface; 0 = from the scan
  double spacing = 0;  // [m] between neighbouring points on a surface; 0 = from the scan
  double voxel = 0;    // [m] edge of the voxels; 0 = from noise and spacing
  double min_noise = 5e-4;         // [m] a scan is not taken to be better than this
  double min_voxel = 0.045;        // [m] voxels are not smaller where their size is derived
  double voxel_per_spacing = 1.5;  // a voxel's edge in spacings
  double voxel_per_noise = 3;      // and at least so many times the noise
  double depth_step = 0;  // [1/m] a depth camera's noise is at least this times range squared
};

// The lengths that a scan is looked at in.
struct Scale {
  double noise = 0;       // [m]
  double spacing = 0;     // [m]
  double voxel = 0;       // [m]
  double depth_step = 0;  // [1/m] noise is at least this times the squared distance from `camera`
  Vec3 camera = Vec3::Zero();

  // The noise of points at p [m].
  double noise_at(const Vec3& p) const {
    return depth_step > 0 ? std::max(noise, depth_step * (p - camera).squaredNorm()) : noise;
  }
  double variance_at(const Vec3& p) const { return noise_at(p) * noise_at(p); }
};

inline std::size_t count_of(const Scale&) { return 3; }

// Looks at a few thousand cells of the scan and fits a plane to each, robustly. Noise is the upper
// quartile of the rms of those that hold one plane (a scanner's noise is along the ray, so the
// cells seen at a slant are too good), spacing the median of theirs.
Scale estimate_scale(const PointCloud& cloud, const ScaleOptions& options = {});

}  // namespace scanworld::rival
