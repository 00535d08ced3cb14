// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "parts.h"
#include "turn.h"
#include "world/solids.h"

namespace scanworld {

namespace {

struct Placed {
  Vec3 position;
  Eigen::Quaterniond rotation;
  std::variant<BoxShape, CylinderShape, ConvexShape> shape;
};

Placed placed(const OrientedBox& box) { return {box.center, box.rotation, BoxShape{box.size}}; }

Placed placed(const Cylinder& cylinder, const Vec3& up) {
  return {cylinder.center, turn_between(Vec3::UnitZ(), up),
          CylinderShape{cylinder.radius, cylinder.height}};
}

// Vertices are kept relative to their mean, so that nothing is lost where they become float.
Placed placed(Mesh mesh) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& v : mesh.vertices) mean += v;
  mean /= static_cast<double>(mesh.vertices.size());
  for (Vec3& v : mesh.vertices) v -= mean;
  return {mean, Eigen::Quaterniond::Identity(), ConvexShape{std::move(mesh)}};
}

// A box that is at least so thick along the normal, grown away from it.
OrientedBox thickened(OrientedBox box, const Vec3& normal, double thickness) {
  const Mat3 axes = box.rotation.toRotationMatrix();
  int axis = 0;
  (axes.transpose() * normal).cwiseAbs().maxCoeff(&axis);
  const double missing = thickness - box.size[axis];
  if (missing <= 0) return box;
  const Vec3 back = (axes.col(axis).dot(normal) > 0 ? -1 : 1) * axes.col(axis);
  box.center += missing / 2 * back;
  box.size[axis] = thickness;
  return box;
}

ConvexPrism thickened(ConvexPrism prism, const Vec3& normal, double thickness) {
  const double depth = prism.extrusion.norm();
  if (depth >= thickness) return prism;
  const Vec3 longer = prism.extrusion * (thickness / depth);
  if (prism.extrusion.dot(normal) > 0)
    for (Vec3& v : prism.base) v -= longer - prism.extrusion;
  prism.extrusion = longer;
  return prism;
}

// A pipe lies as it does, however the world had to hold it.
std::optional<Placed> placed_pipe(const Curve& curve) {
  const RoundShape& s = curve.shape;
  if (s.type != CurveType::cylinder) return std::nullopt;
  return Placed{s.point + (curve.low + curve.high) / 2 * s.axis,
                turn_between(Vec3::UnitZ(), s.axis),
                CylinderShape{s.radius, curve.high - curve.low}};
}

constexpr double kWholeCone = 0.02;  // [radius] that the tip of one is wide

// The hull of a ball, or of a cone that has its tip, in the axes of what it is.
std::optional<RoundBody> round_body(const Curve& curve, Placed& solid) {
  const RoundShape& s = curve.shape;
  auto* hull = std::get_if<ConvexShape>(&solid.shape);
  const double wide = s.radius_at(curve.high), height = curve.high - curve.low;
  const bool is_cone = s.type == CurveType::cone && s.radius_at(curve.low) < kWholeCone * wide;
  if (!hull || !(is_cone || s.type == CurveType::sphere)) return std::nullopt;
  const Vec3 middle = is_cone ? Vec3(s.point + (curve.low + curve.high) / 2 * s.axis) : s.point;
  const Eigen::Quaterniond turn =
      is_cone ? turn_between(Vec3::UnitZ(), -s.axis) : Eigen::Quaterniond::Identity();
  for (Vec3& v : hull->mesh.vertices) v = turn.conjugate() * (v + solid.position - middle);
  solid.position = middle, solid.rotation = turn;
  return RoundBody{s.type, is_cone ? wide : s.radius, is_cone ? height : 2 * s.radius};
}

}  // namespace

std::vector<ExportBody> export_bodies(const World& world, const ExportOptions& options) {
  std::map<int, const Surface*> surface_of;
  for (const Surface& s : world.surfaces) surface_of[s.id] = &s;

  std::vector<ExportBody> bodies;
  const auto add = [&](const std::string& name, bool is_obstacle, Color color, Placed solid) {
    bodies.push_back({name, is_obstacle, color, solid.position, solid.rotation.normalized(),
                      std::move(solid.shape)});
  };
  const auto add_hull = [&](const std::string& name, const Obstacle& o) {
    const auto part = std::find_if(world.curves.begin(), world.curves.end(),
                                   [&](const CurvedPart& c) { return o.curve == c.id; });
    const Color color = color_of(Kind::other);
    if (part == world.curves.end()) return add(name, true, color, placed(mesh_of(o, world.frame)));
    if (const auto pipe = placed_pipe(part->curve)) return add(name, true, color, *pipe);
    Placed solid = placed(mesh_of(o, world.frame));
    const std::optional<RoundBody> round = round_body(part->curve, solid);
    add(name, true, color, std::move(solid));
    bodies.back().round = round;
  };
  std::map<int, int> count;  // of the colliders that a surface has so far
  for (const Collider& c : world.colliders) {
    const Surface& s = *surface_of.at(c.surface);
    const auto solid = [&](const auto& shape) {
      const auto thick = thickened(shape, s.plane.normal, options.min_thickness);
      if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, OrientedBox>)
        return placed(thick);
      else
        return placed(mesh_of(thick));
    };
    add(fmt::format("{}_solid_{}", name_of(s), count[s.id]++), false, color_of(s),
        std::visit(solid, c.shape));
  }
  for (const Obstacle& o : world.obstacles) {
    const std::string name = name_of(o);
    if (const auto* box = std::get_if<OrientedBox>(&o.shape))
      add(name, true, color_of(Kind::other), placed(*box));
    else if (const auto* cylinder = std::get_if<Cylinder>(&o.shape))
      add(name, true, color_of(Kind::other), placed(*cylinder, world.frame.up));
    else
      add_hull(name, o);
  }
  return bodies;
}

Mesh mesh_of(const ExportBody& body) {
  Mesh mesh;
  if (const auto* box = std::get_if<BoxShape>(&body.shape))
    mesh = mesh_of(OrientedBox{.size = box->size});
  else if (const auto* cylinder = std::get_if<CylinderShape>(&body.shape))
    mesh = mesh_of(Cylinder{.radius = cylinder->radius, .height = cylinder->height}, Vec3::UnitZ());
  else
    mesh = std::get<ConvexShape>(body.shape).mesh;
  for (Vec3& v : mesh.vertices) v = body.position + body.rotation * v;
  return mesh;
}

std::string text_of(double number) {
  const std::string text = fmt::format("{:.9g}", number);
  return text == "-0" ? "0" : text;
}

std::string text_of(const Vec3& v) {
  return text_of(v.x()) + " " + text_of(v.y()) + " " + text_of(v.z());
}

std::string wxyz_text(const Eigen::Quaterniond& q) {
  return text_of(q.w()) + " " + text_of(Vec3(q.vec()));
}

std::string rpy_text(const Eigen::Quaterniond& q) {
  const Mat3 r = q.toRotationMatrix();
  const double pitch = std::atan2(-r(2, 0), std::hypot(r(0, 0), r(1, 0)));
  if (std::hypot(r(0, 0), r(1, 0)) > 1e-9)
    return text_of(Vec3(std::atan2(r(2, 1), r(2, 2)), pitch, std::atan2(r(1, 0), r(0, 0))));
  return text_of(Vec3(std::atan2(-r(1, 2), r(1, 1)), pitch, 0));  // roll and yaw are one
}

Eigen::Quaterniond y_up_turn() {
  return Eigen::Quaterniond(Eigen::AngleAxisd(-M_PI / 2, Vec3::UnitX()));
}

Vec3 gravity_of(const World& world) { return -9.81 * world.frame.up; }

}  // namespace scanworld
