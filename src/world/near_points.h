// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cloud_in_world.h"

namespace scanworld {

// How far the nearest point of a cloud is from each of some places [m]: to a millionth where it is
// within `max_distance`, which else stands for all that is farther. All points are looked at; first
// only for those within `reach` of a place, which is enough where most places have one there.
std::vector<double> nearest_point_distances(const std::vector<Vec3>& places,
                                            const CloudInWorld& cloud, double reach,
                                            double max_distance);

struct PlanarOptions {
  double cell = 0.2;              // [m] edge of the cubes whose points are looked at together
  double noise = 0.01;            // [m] of points off their plane
  double rms_per_noise = 1.5;     // points of a cube that are farther from one plane are no plane
  std::size_t min_points = 12;    // in a cube
  double min_spread = 0.125;      // [cell] standard deviation along the plane, so that it has one
  double distance_per_noise = 4;  // a place farther from its cube's plane is not on it
};

// The unit normal, of either sign, of the plane that the scan holds at each place: the one that the
// points of its cube lie in. Nothing where they lie in none.
std::vector<std::optional<Vec3>> planar_normals(const std::vector<Vec3>& places,
                                                const CloudInWorld& cloud,
                                                const PlanarOptions& options = {});

}  // namespace scanworld
