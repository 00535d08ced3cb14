// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "find_frame.h"

#include <fmt/format.h>

#include <cmath>

#include "../polygon.h"

namespace scanworld {

namespace {

constexpr double kMaxPitch = 0.87;  // [rad] of a camera: 50 degrees
constexpr double kMaxTilt = 0.44;   // [rad] of other scans: 25 degrees
constexpr double kDegree = M_PI / 180;

double area_of(const FoundSurface& surface) {
  const PlaneFrame frame = frame_of(surface.plane, surface.outer[0]);
  const auto doubled = [&](const std::vector<Vec3>& loop) {
    std::vector<Vec2> ring;
    for (const Vec3& v : loop) ring.push_back(frame.to_plane(v));
    return doubled_area(ring);
  };
  double sum = doubled(surface.outer);
  for (const auto& hole : surface.holes) sum += doubled(hole);
  return sum / 2;
}

std::string why_up(const Up& up, const Vec3& axis, const char* name) {
  if (up.share == 0) return fmt::format("up is {}: the scan does not say otherwise", name);
  const std::string support = fmt::format(
      "{:.0f} % of what was seen is level or upright to it within {:.0f} degrees{}", 100 * up.share,
      up.tolerance / kDegree,
      up.is_partial ? ", all of it walls that are parallel, which leaves one direction open" : "");
  if (up.direction == axis)
    return fmt::format("up is {}: surfaces say so to {:.2f} degrees; {}", name, up.angle / kDegree,
                       support);
  return fmt::format("up is {:.2f} degrees off {}: {} so; {}", up.angle / kDegree, name,
                     up.is_floors ? "the floor says" : "surfaces say", support);
}

}  // namespace

std::vector<Facing> facings_of(const std::vector<FoundSurface>& surfaces) {
  std::vector<Facing> facings;
  for (const FoundSurface& s : surfaces) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& v : s.outer) sum += v;
    facings.push_back({s.plane.normal, std::max(0.0, area_of(s)) * s.support.coverage,
                       sum / static_cast<double>(s.outer.size())});
  }
  return facings;
}

Frame find_frame(const PointCloud& cloud, const std::vector<Facing>& facings) {
  Frame frame{.origin = cloud.origin,
              .assumed = {"coordinates are metres: the scan does not say otherwise"}};
  const Vec3 axis = cloud.camera_frame ? Vec3(-Vec3::UnitY()) : Vec3(Vec3::UnitZ());
  const Up up = find_up(facings, axis, {.max_angle = cloud.camera_frame ? kMaxPitch : kMaxTilt});
  // A camera's axis says little: the best that surfaces say is better than that.
  const bool is_told = up.is_found || (cloud.camera_frame && up.share > 0);
  frame.up = is_told ? up.direction : axis;
  std::string why = is_told || up.share == 0
                        ? why_up(up, axis, cloud.camera_frame ? "-y" : "+z")
                        : fmt::format(
                              "up is +z: too few surfaces agree on another ({:.0f} % of "
                              "what was seen)",
                              100 * up.share);
  if (cloud.camera_frame)
    why += "; the scan is one image of a camera, in whose frame y points down";
  frame.assumed.push_back(why);
  return frame;
}

}  // namespace scanworld
