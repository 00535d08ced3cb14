// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "../noise_map.h"
#include "../types.h"

namespace scanworld::rival {

struct ScaleOptions {
  double noise = 0;    // [m] standard deviation of the points off their surface; 0 = from the scan
  double spacing = 0;  // [m] between neighbouring points on a surface; 0 = from the scan
  double voxel = 0;    // [m] edge of the voxels; 0 = from noise and spacing
  double min_noise = 5e-4;         // [m] a scan is not taken to be better than this
  double min_voxel = 0.02;         // [m] voxels are not smaller where their size is derived
  double voxel_per_spacing = 1.5;  // a voxel's edge in spacings
  double voxel_per_noise = 3;      // and at least so many times the noise
  double depth_step = 0;   // [1/m] a depth camera's noise is at least this times range squared
  double max_bend = 0.02;  // [m] surfaces are not taken to bend by more; 0 = all are flat
  double max_sag =
      0.002;  // a surface may bend by this share of its extent, however flat others are
};

// How far the scan's surfaces are off planes by themselves, apart from noise: floors sag, and
// registration bends what is straight. The rms off a plane grows with the extent that it is fitted
// over.
struct Flatness {
  struct Sample {
    double extent, bend;  // [m]
  };
  std::vector<Sample> samples;       // of rising extent and bend; none for a scan that is flat
  double max_bend = 0, max_sag = 0;  // [m], and a share of the extent: what a single surface may be
  double drift = 0;  // [m] between the layers of surfaces that the scan shows more than once; 0 =
                     // there are none

  // Beyond the largest extent that was seen it grows in proportion, at most to the double.
  double bend_at(double extent) const;
  // The most that a surface of this extent may bend and still be one.
  double limit_at(double extent) const {
    return std::max(bend_at(extent), std::min(max_bend, max_sag * extent));
  }
};

// The lengths that a scan is looked at in.
struct Scale {
  double noise = 0;       // [m]
  double spacing = 0;     // [m]
  double voxel = 0;       // [m]
  double depth_step = 0;  // [1/m] noise is at least this times the squared distance from `camera`
  Vec3 camera = Vec3::Zero();
  Flatness flatness;
  NoiseMap local;  // where there is more noise than `noise`

  // The noise of points at p [m].
  double noise_at(const Vec3& p) const {
    const double least = std::max(noise, local.at(p));
    return depth_step > 0 ? std::max(least, depth_step * (p - camera).squaredNorm()) : least;
  }
  double variance_at(const Vec3& p) const { return noise_at(p) * noise_at(p); }
};

// The most that points may be off their surface, squared and in squared noise: one may be an
// outlier of its noise, the mean of many may not.
inline double square_off(double max_rms, double max_distance, double points) {
  const double many = max_rms * max_rms, one = max_distance * max_distance;
  return many + (one - many) / points;
}

inline std::size_t count_of(const Scale&) { return 3; }
inline std::size_t count_of(const Flatness& flatness) { return flatness.samples.size(); }

// Looks at a few thousand cells of the scan and fits a plane to each, robustly. Noise is the upper
// quartile of the rms of those that hold one plane (a scanner's noise is along the ray, so the
// cells seen at a slant are too good), spacing the median of theirs.
Scale estimate_scale(const PointCloud& cloud, const ScaleOptions& options = {});

}  // namespace scanworld::rival
