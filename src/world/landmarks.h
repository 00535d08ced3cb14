// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "world.h"

namespace scanworld {

enum class LandmarkKind {
  corner,  // a vertex where three or more surfaces meet that are not parallel to one line
  edge,    // an upright line where two walls meet
};

// How the surfaces of a landmark lie to each other, seen from the free side.
enum class Relief {
  concave,  // as in the corner of a room
  convex,   // as at the corner of a cupboard
  mixed,    // as at the foot of a door's jamb
};

// A place that a robot can tell from others, and how well its position is known.
struct Landmark {
  int id = 0;  // stable between runs
  LandmarkKind kind = LandmarkKind::corner;
  Relief relief = Relief::mixed;
  Vec3 foot = Vec3::Zero(), top = Vec3::Zero();  // of an edge; of a corner both are the corner
  std::vector<int> surfaces;                     // ids, ascending
  // [m2] of the position in the world's axes; that of an edge is across it, 0 along up. Missing
  // where too few of its surfaces were measured.
  std::optional<Mat3> covariance;
};

struct LandmarkOptions {
  double min_angle = 0.26;  // [rad] at which surfaces meet (15 degrees)
  double max_tilt = 0.09;   // [rad] of walls and of the edges between them (5 degrees)
  double min_height = 0.5;  // [m] of edges
};

// The corners of a world in the order of its vertices, then its upright edges. Surfaces meet where
// they share vertices, as in exact worlds (docs/world.md).
//
// A plane is known at a point with the variance of a regression, rms^2 / n * (1 + d' C^-1 d), n its
// number of points, d from the middle of the polygon to the point and C the polygon's second
// moments; the covariance of a point on several planes is (sum of n n' / variance)^-1, n here their
// normals. docs/maps.md tells what that leaves out.
std::vector<Landmark> find_landmarks(const World& world, const LandmarkOptions& options = {});

// The landmark nearest to a point, if one is within `max_distance` [m]; the first of those that are
// equally near. Edges are near along their whole length.
const Landmark* nearest_landmark(const std::vector<Landmark>& landmarks, const Vec3& point,
                                 double max_distance = std::numeric_limits<double>::max());

const char* name_of(LandmarkKind kind);
const char* name_of(Relief relief);

}  // namespace scanworld
