// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "types.h"

namespace scanworld {

enum class CurveType { cylinder, sphere };

// A cylinder, or a sphere, without ends.
struct RoundShape {
  CurveType type = CurveType::cylinder;
  Vec3 point = Vec3::Zero();  // on the axis, or the middle
  Vec3 axis = Vec3::UnitZ();  // unit vector; of a sphere what its extent is measured along
  double radius = 0;          // [m]

  // From the axis, or from the middle.
  Vec3 way_to(const Vec3& p) const {
    const Vec3 way = p - point;
    return type == CurveType::sphere ? way : way - axis.dot(way) * axis;
  }
  double signed_distance(const Vec3& p) const { return way_to(p).norm() - radius; }
  // Outwards; of unit length but on the axis itself.
  Vec3 normal_at(const Vec3& p) const { return way_to(p).normalized(); }
  bool operator==(const RoundShape&) const = default;
};

// A part of a round surface: between two heights along the axis and two angles about it.
struct Curve {
  RoundShape shape;
  double low = 0, high = 0;    // [m] along the axis, from the shape's point
  Vec3 start = Vec3::UnitX();  // unit vector across the axis, to where the part begins
  double sweep = 2 * M_PI;     // [rad] how far it goes from there, to the left
  bool hollow = false;         // the free side is inside, as of a vault
  Support support;

  double height_of(const Vec3& p) const { return shape.axis.dot(p - shape.point); }
  // About the axis from `start`, 0 to 2 pi.
  double angle_of(const Vec3& p) const {
    const Vec3 way = p - shape.point;
    const double angle = std::atan2(way.dot(shape.axis.cross(start)), way.dot(start));
    return angle < 0 ? angle + 2 * M_PI : angle;
  }
  bool operator==(const Curve&) const = default;
};

}  // namespace scanworld
