// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fit_solid.h"

namespace scanworld {

constexpr int kFewestSides = 6;

// Whether a curve is a thing of its own and not the border of a room: a column, a pipe or a cone
// seen from outside, over a third of its side or more, or a ball seen from above its middle to
// below.
bool is_solid(const Curve& curve);

// The solid that such a curve is: a cylinder where it is an upright one, else the hull of its
// corners.
Solid solid_of(const Curve& curve, const Vec3& up);

// How many sides stand for a circle, so that a chord is off by no more than the sagitta [m].
int sides_of(double radius, double sagitta);

// The corners of a curve's hull, which lie on it: two rings, one of them a point at the apex of a
// cone, or the rings of a ball.
std::vector<Vec3> corners_of(const Curve& curve, int sides);

}  // namespace scanworld
