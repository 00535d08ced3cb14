// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "camera.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "error.h"
#include "turn.h"
#include "world/solids.h"

namespace scanworld {

namespace {

constexpr double kAzimuth = 3.75, kElevation = 0.75;  // [rad] of the view from the corner
constexpr double kAround = 1.05;                      // around all that is there
constexpr double kHalfField = 0.5;  // tangent of half the field of view: 53 degrees

// With `up` upright in the picture, or where one looks along it, with y.
Camera looking(const Vec3& eye, const Vec3& ahead, const Vec3& up) {
  Vec3 right = ahead.cross(up);
  if (right.norm() < 1e-6) right = ahead.cross(turn_between(Vec3::UnitZ(), up) * Vec3::UnitY());
  right.normalize();
  return {eye, right, right.cross(ahead), ahead};
}

// Far enough away to see all of a world, and wide enough.
Camera orthographic(const World& world, const Vec3& ahead, double aspect) {
  const Box3 box = bounds(world);
  const double reach = std::max(box.sizes().norm(), 1e-3);
  Camera camera = looking(box.center() - reach * ahead, ahead, world.frame.up);
  camera.orthographic = true;
  double wide = 0, high = 0;
  const auto look_at = [&](const Vec3& p) {
    wide = std::max(wide, std::abs(camera.right.dot(p - box.center())));
    high = std::max(high, std::abs(camera.up.dot(p - box.center())));
  };
  for (const Vec3& v : world.vertices) look_at(v);
  for (const Obstacle& o : world.obstacles)
    for (const Vec3& v : mesh_of(o, world.frame).vertices) look_at(v);
  camera.half_height = kAround * std::max({high, wide / aspect, 1e-3});
  return camera;
}

}  // namespace

Camera camera_from_top(const World& world, double aspect) {
  return orthographic(world, -world.frame.up, aspect);
}

Camera camera_from_corner(const World& world, double aspect) {
  const Vec3 level(std::cos(kAzimuth), std::sin(kAzimuth), 0);
  const Vec3 from = std::cos(kElevation) * level + std::sin(kElevation) * Vec3::UnitZ();
  const Vec3 ahead = turn_between(Vec3::UnitZ(), world.frame.up) * Vec3(-from);
  return orthographic(world, ahead, aspect);
}

Camera camera_at(const World& world, const Vec3& eye) {
  const Vec3 way = bounds(world).center() - eye;
  const Vec3 ahead = way.norm() > 1e-6 ? Vec3(way.normalized()) : Vec3(Vec3::UnitX());
  Camera camera = looking(eye, ahead, world.frame.up);
  camera.half_height = kHalfField;
  return camera;
}

Camera camera_named(const std::string& name, const World& world, double aspect) {
  if (name == "top") return camera_from_top(world, aspect);
  if (name == "iso") return camera_from_corner(world, aspect);
  std::istringstream in(name);
  Vec3 eye;
  char comma = ',', other = ',';
  if (in >> eye.x() >> comma >> eye.y() >> other >> eye.z() && comma == ',' && other == ',' &&
      (in >> std::ws).eof() && eye.allFinite())
    return camera_at(world, eye);
  throw Error(Cause::usage,
              fmt::format("--from: '{}' is none of top, iso and a place x,y,z", name));
}

}  // namespace scanworld
