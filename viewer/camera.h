// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "world/world.h"

namespace scanworld {

// Where a picture is taken from. The picture's middle is straight ahead.
struct Camera {
  Vec3 eye = Vec3::Zero();
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY(), ahead = -Vec3::UnitZ();  // unit vectors
  bool orthographic = false;
  // Half the height of what is seen: [m] where orthographic, else per metre ahead.
  double half_height = 0.5;
};

// From straight above, with y up where the world is upright; `aspect` is width over height of the
// picture.
Camera camera_from_top(const World& world, double aspect);

// From above at a slant, so that one looks into rooms; orthographic.
Camera camera_from_corner(const World& world, double aspect);

// From a place to the middle of the world.
Camera camera_at(const World& world, const Vec3& eye);

// The one called "top", "iso" (from_corner) or "x,y,z" (at). Throws usage for anything else.
Camera camera_named(const std::string& name, const World& world, double aspect);

}  // namespace scanworld
