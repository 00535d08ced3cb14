// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Things that stand about, as points, and worlds for them to stand in.
#pragma once

#include "scenes.h"
#include "world/world.h"

namespace scanworld::test {

constexpr double kThingSpacing = 0.02;  // [m] between points

// Points of a sphere's surface, as dense as a square of `spacing` each, with noise.
void add_ball(std::vector<Vec3>& points, const Vec3& center, double radius, double spacing,
              double noise, Random& random);

// The side and the top of an upright cylinder; only what a scanner at `from` [rad] sees, where
// `arc` is less than a full turn.
void add_drum(std::vector<Vec3>& points, const Vec3& center, double radius, double height,
              double spacing, double noise, Random& random, double from = 0, double arc = 7);

// The four sides and the top of a box turned about the vertical.
void add_crate(std::vector<Vec3>& points, const Vec3& center, const Vec3& size, double angle,
               double spacing, double noise, Random& random);

// A world of a level floor at height 0, 10 m by 10 m about the origin.
World floor_world();

// How far a point is from the surface of a convex solid [m]; negative inside.
double outside_of(const Obstacle& obstacle, const Frame& frame, const Vec3& point);

}  // namespace scanworld::test
