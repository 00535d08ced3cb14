// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <variant>

#include "world.h"

namespace scanworld {

struct SolidOptions {
  double tolerance = 3;    // [noise] points no farther from a face lie on it
  double min_share = 0.9;  // of the points, on the faces of a cylinder or box
  double min_arc = 2;      // [rad] of a cylinder with points, in all
  double max_empty = 1.3;  // a box holds no more than this times what the hull of its points does
  int max_vertices = 32;   // of a hull
};

using Solid = std::variant<OrientedBox, ConvexHull, Cylinder>;

// The upright cylinder whose side, top and bottom these points lie on; nothing where they do not.
// What was seen of its side may be a part. `noise` [m] is that of the points.
std::optional<Cylinder> fit_cylinder(std::span<const Vec3> points, const Vec3& up, double noise,
                                     const SolidOptions& options = {});

// The upright box on whose faces these points lie; nothing where they do not.
std::optional<OrientedBox> fit_box(std::span<const Vec3> points, const Vec3& up, double noise,
                                   const SolidOptions& options = {});

// The convex hull of these points by few vertices, without the noise of the outermost ones; a box
// where they lie in a plane.
Solid enclose(std::span<const Vec3> points, double noise, const SolidOptions& options = {});

// The cylinder, else the box, on whose faces these points lie; nothing where they do not.
std::optional<Solid> fit_simple(std::span<const Vec3> points, const Vec3& up, double noise,
                                const SolidOptions& options = {});

// The simplest solid that fits: a cylinder, else a box, else a hull.
Solid fit_solid(std::span<const Vec3> points, const Vec3& up, double noise,
                const SolidOptions& options = {});

}  // namespace scanworld
