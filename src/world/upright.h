// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "triangulate.h"
#include "world.h"

namespace scanworld {

// A world turned upright, so that plans of it can be drawn in x and y.
struct Upright {
  // Throws check_failed naming a surface that is no valid polygon.
  explicit Upright(const World& world);

  std::array<Vec3, 3> corners(std::size_t triangle) const;
  std::vector<Vec3> ring(const Loop& loop) const;

  Eigen::Quaterniond turn;    // from the world's axes
  WorldMesh mesh;             // turned
  std::vector<Vec3> normals;  // of surfaces
};

// The height of an upright world's plane at a place; its normal may not be level.
inline double height_at(const Vec3& normal, double offset, const Vec2& p) {
  return -(normal.head<2>().dot(p) + offset) / normal.z();
}

// Where a segment passes a height, seen from above; nothing where it does not.
std::optional<Vec2> crossing(const Vec3& p, const Vec3& q, double height);

// Where a surface is cut by a level plane.
struct WallCut {
  std::size_t surface;  // index
  Vec2 a, b;
  Vec2 front;  // unit vector to its free side
};

// A piece for each triangle that is cut at a height.
std::vector<WallCut> cut_at(double height, const Upright& upright);

}  // namespace scanworld
