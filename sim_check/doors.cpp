// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "robustness.h"
#include "sampler.h"
#include "world/triangulate.h"

namespace scanworld::sim {

namespace {

constexpr double kRaised = 0.05;  // [m] over the sill, as on wheels
constexpr double kReach = 0.3;    // [m] before and behind a door
constexpr double kDepth = 0.1;    // [m] of the robot, along its way

// The middle of an opening's lower edge, and its frame in the wall.
struct Sill {
  Vec3 middle;
  PlaneFrame frame;
};

Sill sill_of(const World& world, const Opening& opening, const Plane& plane) {
  const PlaneFrame frame =
      upright_frame(plane, world.frame.up, world.vertices[opening.loop.front()]);
  Eigen::AlignedBox2d box;
  for (int v : opening.loop) box.extend(frame.to_plane(world.vertices[v]));
  return {frame.to_space({box.center().x(), box.min().y()}), frame};
}

// A box that looks along the normal of a wall.
Pose facing(const Vec3& at, const PlaneFrame& wall, const Vec3& normal) {
  Mat3 axes;
  axes << wall.u, normal, wall.u.cross(normal);
  return {at, Eigen::Quaterniond(axes)};
}

// Whether a robot gets through a door, both ways, straight on.
bool gets_through(const World& world, const Opening& door, Simulation& simulation,
                  const RobustnessOptions& options) {
  const Plane& plane = find_surface(world, door.surface)->plane;
  const Sill sill = sill_of(world, door, plane);
  const double height = std::min(options.height, door.height - 2 * kRaised);
  const Vec3 size(options.width, kDepth, height);
  const Vec3 middle = sill.middle + (kRaised + height / 2) * sill.frame.v;
  for (double sign : {-1, 1}) {
    const Vec3 from = middle + sign * kReach * plane.normal,
               to = middle - sign * kReach * plane.normal;
    if (simulation.sweep(size, facing(from, sill.frame, plane.normal), to) < 1) return false;
  }
  return true;
}

// Tries to go through walls, at places chosen by area.
void try_walls(const World& world, Simulation& simulation, const RobustnessOptions& options,
               Doors& doors) {
  const WorldMesh triangles = triangulate(world);
  const auto surface_of = [&](std::size_t triangle) -> const Surface& {
    return world.surfaces[static_cast<std::size_t>(triangles.surface[triangle])];
  };
  const Sampler walls(triangles.mesh,
                      [&](std::size_t i) { return surface_of(i).kind == Kind::wall; });
  if (walls.empty()) return;
  Random random(options.seed + 7);
  const Vec3 size = Vec3::Constant(options.size);
  for (std::size_t k = 0; k < options.walls; ++k) {
    const auto [p, triangle] = walls.draw(random);
    const Vec3& normal = surface_of(triangle).plane.normal;
    ++doors.walls;
    doors.walls_open += simulation.sweep(size, {p + kReach * normal}, p - kReach * normal) >= 1;
  }
}

}  // namespace

Doors go_through(const World& truth, Simulation& simulation, const RobustnessOptions& options) {
  Doors doors;
  for (const Opening& opening : truth.openings) {
    if (opening.kind != OpeningKind::door) continue;
    if (opening.width < options.width + options.margin) {
      ++doors.narrow;
      continue;
    }
    ++doors.wide;
    if (gets_through(truth, opening, simulation, options))
      ++doors.passed;
    else
      doors.blocked.push_back(opening.id);
  }
  try_walls(truth, simulation, options, doors);
  return doors;
}

}  // namespace scanworld::sim
