// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../options.h"
#include "world.h"

namespace scanworld {

struct LevelOptions {
  bool level = false;          // turn the world so that up is +Z
  bool floor_at_zero = false;  // move it along up so that its main floor is at height 0
};

OptionList list_options(LevelOptions& options);

// How far a world's up is off +Z [rad].
double tilt_of(const Frame& frame);

// The smallest turn that makes up +Z, so that headings stay.
Eigen::Quaterniond upright_turn(const Frame& frame);

// The floor with the largest area, the first of equal ones; null where there is no floor.
const Surface* main_floor(const World& world);

// The same place in other coordinates: p becomes rotation * p + shift. The frame follows, so that
// Frame::to_scan of a thing is what it was. Vertices are rounded to the micrometre.
World moved(World world, const Eigen::Quaterniond& rotation, const Vec3& shift);

// The world upright, by the smallest turn that brings up to +Z exactly, so that headings stay; and
// the main floor at height 0 (z = 0 of an upright world) at the middle of its area. What was done
// is added to Frame::assumed. Where nothing is asked for or to be done, nothing changes.
World level_world(World world, const LevelOptions& options);

}  // namespace scanworld
