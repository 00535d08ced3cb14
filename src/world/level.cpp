// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "level.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "turn.h"

namespace scanworld {

namespace {

// To the micrometre [m].
double rounded(double x) { return static_cast<double>(std::llround(x * 1e6)) / 1e6; }

struct Motion {
  Eigen::Quaterniond rotation;
  Vec3 shift;

  Vec3 operator()(const Vec3& p) const { return rotation * p + shift; }
  void apply(OrientedBox& b) const {
    b.center = (*this)(b.center);
    b.rotation = (rotation * b.rotation).normalized();
  }
  void apply(ConvexHull& h) const {
    for (Vec3& v : h.vertices) v = (*this)(v);
  }
  void apply(Cylinder& c) const { c.center = (*this)(c.center); }  // its axis is Frame::up
  void apply(ConvexPrism& p) const {
    for (Vec3& v : p.base) v = (*this)(v);
    p.extrusion = rotation * p.extrusion;
  }
};

}  // namespace

OptionList list_options(LevelOptions& o) {
  return {{"frame.level", &o.level, "", "turn the world upright, as --level does"},
          {"frame.floor_at_zero", &o.floor_at_zero, "",
           "move its main floor to height 0, as --floor-at-zero does"}};
}

double tilt_of(const Frame& frame) {
  return std::atan2(std::hypot(frame.up.x(), frame.up.y()), frame.up.z());
}

Eigen::Quaterniond upright_turn(const Frame& frame) {
  return turn_between(frame.up, Vec3::UnitZ());
}

const Surface* main_floor(const World& world) {
  const Surface* largest = nullptr;
  for (const Surface& s : world.surfaces)
    if (s.kind == Kind::floor && (!largest || area(world, s) > area(world, *largest))) largest = &s;
  return largest;
}

World moved(World world, const Eigen::Quaterniond& rotation, const Vec3& shift) {
  const Motion motion{rotation.normalized(), shift};
  for (Vec3& v : world.vertices) v = motion(v).unaryExpr(&rounded);
  for (Surface& s : world.surfaces) {
    s.plane.normal = (motion.rotation * s.plane.normal).normalized();
    s.plane.offset -= s.plane.normal.dot(shift);
    for (InferredPart& part : s.inferred) {
      const auto move = [&](std::vector<Vec3>& ring) {
        for (Vec3& v : ring) v = motion(v).unaryExpr(&rounded);
      };
      move(part.outer);
      std::for_each(part.holes.begin(), part.holes.end(), move);
    }
  }
  for (Room& r : world.rooms)
    if (r.center) r.center = motion(*r.center).unaryExpr(&rounded);
  for (Way& w : world.ways)
    for (Vec3* end : {&w.foot, &w.top}) *end = motion(*end).unaryExpr(&rounded);
  for (CurvedPart& c : world.curves) {
    RoundShape& shape = c.curve.shape;
    shape.point = motion(shape.point), shape.axis = (motion.rotation * shape.axis).normalized();
    c.curve.start = (motion.rotation * c.curve.start).normalized();
  }
  const auto apply = [&](auto& shape) { motion.apply(shape); };
  for (Obstacle& o : world.obstacles) std::visit(apply, o.shape);
  for (Collider& c : world.colliders) std::visit(apply, c.shape);
  Frame& frame = world.frame;
  frame.rotation = (frame.rotation * motion.rotation.conjugate()).normalized();
  frame.origin -= frame.rotation * shift;
  frame.up = (motion.rotation * frame.up).normalized();
  return world;
}

World level_world(World world, const LevelOptions& options) {
  if (const double tilt = tilt_of(world.frame); options.level && tilt > 0) {
    world = moved(std::move(world), upright_turn(world.frame), Vec3::Zero());
    world.frame.up = Vec3::UnitZ();
    world.frame.assumed.push_back(
        fmt::format("turned upright on request, by {:.2f} degrees", tilt * 180 / M_PI));
  }
  if (!options.floor_at_zero) return world;
  const Surface* floor = main_floor(world);
  if (!floor) {
    world.frame.assumed.push_back("not moved to its floor: there is none");
    return world;
  }
  const double height = rounded(world.frame.up.dot(centroid(world, *floor)));
  const int id = floor->id;
  world = moved(std::move(world), Eigen::Quaterniond::Identity(), -height * world.frame.up);
  world.frame.assumed.push_back(fmt::format(
      "moved on request, by {:.3f} m along up, so that its largest floor (surface {}) is at 0",
      -height, id));
  return world;
}

}  // namespace scanworld
