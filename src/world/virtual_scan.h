// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "world.h"

namespace scanworld {

struct VirtualScanOptions {
  std::vector<Vec3> poses;   // scanner positions in the world's frame; empty: place_scanners()
  std::size_t points = 0;    // thin or refine to this number; 0 = as the resolution gives
  double resolution = 0.01;  // [rad] between neighbouring rays, where `points` is 0
  double lowest =
      -1.1345;  // [rad] elevation that the scanner sees down to (-65 degrees); up to the zenith
  double max_range = 60;  // [m]
  double noise = 0.01;    // [m] standard deviation of a range
  double outliers = 0;    // share of all points, spread over the box of the world grown by 10 %
  double mixed = 0;       // chance that a ray at a jump edge returns a point between the two
  std::uint64_t seed = 1;
};

// What the ray of a point met.
enum class PointKind : std::int32_t { surface = 0, obstacle = 1, mixed = 2, outlier = 3 };

struct VirtualScan {
  PointCloud cloud;                   // as the world's frame says; viewpoints: the poses
  std::vector<std::int32_t> surface;  // for each point the id of its surface, -1 = none
  std::vector<std::int32_t> kind;     // for each point a PointKind
  std::vector<std::int32_t> pose;     // for each point the index of its pose
};

// Scans a world as laser scanners at the poses, upright on its z axis, would: rays over the sphere,
// equally spaced in azimuth and elevation, with noise, points between near and far at edges, fewer
// returns from grazing rays, and stray points. Every ray has random numbers of its own, so the scan
// does not depend on the number of threads. Throws usage where an option is out of range,
// nothing_found where no ray meets anything.
VirtualScan virtual_scan(const World& world, const VirtualScanOptions& options);

struct PlaceOptions {
  double height = 1.5;      // [m] above the floor
  double spacing = 0.5;     // [m] between the places that are tried
  double clearance = 0.35;  // [m] to the nearest surface
  double reach = 3;         // [m] what is farther away counts as not seen
};

// Positions from which scanners together see all places over the floors: the one that sees most of
// what is not seen yet, and so on.
std::vector<Vec3> place_scanners(const World& world, const PlaceOptions& options = {});

}  // namespace scanworld
