// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// Shapes about the origin of their own axes.
struct BoxShape {
  Vec3 size;  // [m] full edge lengths
};
struct CylinderShape {
  double radius, height;  // [m] along z, from -height/2 to height/2
};
struct ConvexShape {
  Mesh mesh;  // closed, its vertices those of the hull alone
};

// What a convex shape is exactly, for formats that have balls and cones.
struct RoundBody {
  CurveType type;         // sphere, or cone with its tip up along z; cylinders are shapes
  double radius, height;  // [m] height: of a cone, from -height/2 to height/2
};

// A solid that does not move, as physics engines want it.
struct ExportBody {
  std::string name;  // "wall_12_solid_0", "obstacle_3": unique, the same between runs and formats
  bool is_obstacle;
  Color color;  // of what it stands for
  Vec3 position;
  Eigen::Quaterniond rotation;  // from its axes to the world's
  std::variant<BoxShape, CylinderShape, ConvexShape> shape;
  std::optional<RoundBody> round = {};
};

inline bool is_ball(const ExportBody& body) {
  return body.round && body.round->type == CurveType::sphere;
}

// All colliders in the order of the world, then all obstacles. Colliders thinner than
// `min_thickness` grow away from the free side of their surface.
std::vector<ExportBody> export_bodies(const World& world, const ExportOptions& options);

// A body as triangles, in the world's axes; a cylinder has facets.
Mesh mesh_of(const ExportBody& body);

// Numbers in text formats: 9 digits, no minus before zero.
std::string text_of(double number);
std::string text_of(const Vec3& v);                  // "x y z"
std::string wxyz_text(const Eigen::Quaterniond& q);  // "w x y z"
std::string rpy_text(const Eigen::Quaterniond& q);   // roll, pitch, yaw about fixed axes [rad]

// The turn from Z up to Y up.
Eigen::Quaterniond y_up_turn();

// Gravity [m/s2], against the world's up.
Vec3 gravity_of(const World& world);

}  // namespace scanworld
