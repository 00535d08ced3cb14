// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fit_solid.h"

namespace scanworld {

// Whether a curve is a thing of its own, a column or a pipe, and not the border of a room: a
// cylinder seen from outside, over a third of its side or more.
bool is_solid(const Curve& curve);

// The solid that such a curve is: a cylinder where it is upright, else a prism of many sides.
Solid solid_of(const Curve& curve, const Vec3& up);

}  // namespace scanworld
