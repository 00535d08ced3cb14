// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Scans of rectangles whose points are known to be theirs.
#pragma once

#include "scenes.h"
#include "surface/surface.h"

namespace scanworld::test {

// Planes with their points, as a method would find them.
struct LabelledScan {
  PointCloud cloud;
  std::vector<std::int32_t> labels;
  std::vector<Plane> planes;

  // Adds a rectangle, on jittered points 2 cm apart; its plane's normal is that of a x b. More of
  // the same plane where `plane` says so.
  int add(const Vec3& corner, const Vec3& a, const Vec3& b, int plane = -1, double noise = 0.003);
  // The patches, turned to their free side.
  std::vector<surface::Patch> patches() const;
  // The same, their gaps weighed between their seams.
  std::vector<surface::Patch> weighed_patches() const;
  surface::Surroundings surroundings() const;  // with the viewpoints
  surface::Members members() const { return surface::group_points(labels, planes.size()); }

 private:
  Random random_{7};
};

// What the cell around a point says for the surface.
float evidence_at(const surface::Patch& patch, const Vec3& p);

// A raster around the rectangle from 0 to `size` [m], all of it without points.
surface::Patch blank_patch(const Vec2& size, double cell);

// One in which every cell says something by chance, 4 m by 3 m.
surface::Patch random_patch(std::uint64_t seed);

// A line in the plane z = 0 from a point to another, where it may cut and is seen.
surface::CutLine line_through(const Vec2& from, const Vec2& to, int other);
std::vector<surface::CutLine> random_lines(int count, std::uint64_t seed);

// The area of a ring of vertices [m2], positive where it is counter-clockwise.
double area_of(const surface::Arrangement& arrangement, const std::vector<int>& ring);
double area_of(const surface::Arrangement& arrangement, const surface::Arrangement::Cell& cell);

}  // namespace scanworld::test
