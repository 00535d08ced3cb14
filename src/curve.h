// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "types.h"

namespace scanworld {

enum class CurveType { cylinder, sphere, cone };

// A cylinder, sphere or cone, without ends.
struct RoundShape {
  CurveType type = CurveType::cylinder;
  Vec3 point = Vec3::Zero();  // on the axis, or the middle
  Vec3 axis = Vec3::UnitZ();  // unit vector; of a sphere what its extent is measured along
  double radius = 0;      // [m] of a cone where its axis has the point; 0 where that is its apex
  double half_angle = 0;  // [rad] of a cone, by which it widens along the axis; of others 0

  // From the axis, or from the middle.
  Vec3 way_to(const Vec3& p) const {
    const Vec3 way = p - point;
    return type == CurveType::sphere ? way : way - axis.dot(way) * axis;
  }
  // Beside a point.
  double radius_at(const Vec3& p) const { return radius_at(axis.dot(p - point)); }
  double radius_at(double height) const {
    return type == CurveType::cone ? radius + height * std::tan(half_angle) : radius;
  }
  double signed_distance(const Vec3& p) const {
    return (way_to(p).norm() - radius_at(p)) * std::cos(half_angle);
  }
  // Outwards; of unit length but on the axis itself.
  Vec3 normal_at(const Vec3& p) const {
    const Vec3 out = way_to(p).normalized();
    return type == CurveType::cone ? std::cos(half_angle) * out - std::sin(half_angle) * axis : out;
  }
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

  // Halfway along the axis [m].
  double radius() const { return shape.radius_at((low + high) / 2); }
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
