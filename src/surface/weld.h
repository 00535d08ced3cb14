// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "../types.h"

namespace scanworld::surface {

// A corner of a polygon by the planes that meet there, so that all polygons there have the same.
struct Corner {
  std::array<int, 3> planes{};  // ascending
  int next = 0;                 // of them, the one that the outline follows, beside the polygon's
  Vec3 at = Vec3::Zero();
};

struct CornerPolygon {
  int patch = 0;                           // whose plane it is in
  std::vector<std::vector<Corner>> loops;  // outer ones counter-clockwise, holes clockwise
};

// A polygon in a patch's plane: the outer loop first, counter-clockwise seen against the plane's
// normal; the others are holes.
struct Piece {
  int patch = 0;
  std::vector<std::vector<Vec3>> loops;
};

struct WeldOptions {
  double same = 0.005;  // [m] corners nearer than this are one, planes that only cut, and lines ...
  double off_plane = 0.0009;  // [m] ... if that takes corners no farther off the polygons' planes
  double min_area = 1e-3;     // [m2] of a loop that is kept
};

// The polygons as points. Planes that are nearly one count as one. Corners of the same planes are
// at the same point, where those meet; corners that are nearly one become one; and where a corner
// of one polygon lies on another's edge that goes along, that has a vertex there too. A polygon
// that would cross itself by this keeps more of its own corners.
std::vector<Piece> weld(const std::vector<CornerPolygon>& polygons,
                        const std::vector<Plane>& planes, const WeldOptions& options = {});

}  // namespace scanworld::surface
