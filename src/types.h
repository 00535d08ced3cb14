// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The value types that stages pass to each other.
//
// Units: metres, radians, seconds, kilograms. Axes: right-handed, +Z up. Numbers are double; points
// of a scan are stored as float, relative to an origin that is kept in double (see
// PointCloud::origin).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace scanworld {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec3f = Eigen::Vector3f;
using Mat3 = Eigen::Matrix3d;
using Box3 = Eigen::AlignedBox3d;

// [m] What is farther out is on no planet of ours, map projections included.
inline constexpr double kFarthest = 1 << 30;

// The box, larger by a margin to all sides.
inline Box3 grown(const Box3& box, double margin) {
  return {box.min().array() - margin, box.max().array() + margin};
}

// The one of some points, at least one, that is nearest to p; the first of equal ones.
inline const Vec3& nearest_of(std::span<const Vec3> points, const Vec3& p) {
  return *std::min_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
    return (a - p).squaredNorm() < (b - p).squaredNorm();
  });
}

struct Color {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Color&) const = default;
};

// The points x with normal·x + offset = 0, |normal| = 1. A surface's normal points to its free
// side.
struct Plane {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0;  // [m]

  double signed_distance(const Vec3& p) const { return normal.dot(p) + offset; }
  Vec3 project(const Vec3& p) const { return p - signed_distance(p) * normal; }
  Plane flipped() const { return {-normal, -offset}; }
  bool operator==(const Plane&) const = default;
};

// The plane through `point` with the given unit normal.
inline Plane plane_through(const Vec3& point, const Vec3& unit_normal) {
  return {unit_normal, -unit_normal.dot(point)};
}

// A right-handed orthonormal frame in a plane: (u, v, normal), with its 2D origin at `origin`.
struct PlaneFrame {
  Vec3 origin, u, v;

  Vec2 to_plane(const Vec3& p) const { return {u.dot(p - origin), v.dot(p - origin)}; }
  Vec3 to_space(const Vec2& p) const { return origin + u * p.x() + v * p.y(); }
};

// The frame of `plane` whose origin is the point of the plane nearest to `near`. It depends on
// nothing else, so that equal planes have equal frames.
inline PlaneFrame frame_of(const Plane& plane, const Vec3& near = Vec3::Zero()) {
  // The axis least aligned with the normal gives the best conditioned cross product.
  int axis = 0;
  plane.normal.cwiseAbs().minCoeff(&axis);
  const Vec3 u = Vec3::Unit(axis).cross(plane.normal).normalized();
  return {plane.project(near), u, plane.normal.cross(u)};
}

// The frame of a plane that is not level, with v as upright as can be; seen from the side that its
// normal points to, u goes to the right.
inline PlaneFrame upright_frame(const Plane& plane, const Vec3& up, const Vec3& origin) {
  const Vec3 v = (up - up.dot(plane.normal) * plane.normal).normalized();
  return {origin, v.cross(plane.normal), v};
}

// A scan. Every point is finite.
struct PointCloud {
  std::vector<Vec3f> points;     // relative to `origin`
  std::vector<Vec3f> normals;    // unit vectors, or zero where unset; empty, or one for each point
  std::vector<Color> colors;     // empty, or one for each point
  Vec3 origin = Vec3::Zero();    // [m] what was subtracted from the coordinates in the file
  std::vector<Vec3> viewpoints;  // scanner positions relative to `origin`, where they are known
  // Of each point the viewpoint that it was seen from, by its index, or -1 where that is unknown.
  // One for each point, or empty where it is known of none; a single viewpoint then saw them all.
  std::vector<std::int32_t> viewers;
  std::vector<std::size_t>
      skipped;  // ascending positions in the input of points left out as not finite
  bool camera_frame =
      false;  // the points are one image of a pinhole camera: x right, y down, z ahead

  std::size_t input_size() const { return points.size() + skipped.size(); }
  std::int32_t viewer_of(std::size_t point) const { return viewers.empty() ? -1 : viewers[point]; }
};

// An indexed triangle mesh, counter-clockwise seen from outside.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
};

inline void append(Mesh& mesh, const Mesh& more) {
  const int base = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const auto& t : more.triangles)
    mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
}

// How well the points of a scan carry a surface. All zero where there is no scan.
struct Support {
  std::size_t points = 0;
  double rms = 0;       // [m] of the points' distances from the plane
  double coverage = 0;  // share of the area that has points, 0 to 1
  bool operator==(const Support&) const = default;
};

// Whether a surface was seen, or was put where it must be though nothing saw it.
enum class Source { measured, inferred };

// A part of a surface where nothing was measured: rings in its plane, turning as the surface's do.
struct InferredPart {
  std::vector<Vec3> outer;
  std::vector<std::vector<Vec3>> holes;
  bool operator==(const InferredPart&) const = default;
};

// A planar polygon that a method found in a scan: outer loop counter-clockwise seen against the
// plane's normal, which points to the free side; holes clockwise.
struct FoundSurface {
  Plane plane;
  std::vector<Vec3> outer;
  std::vector<std::vector<Vec3>> holes;
  Source source = Source::measured;
  Support support;
  std::optional<Color> color;               // the mean of its points'
  std::optional<int> curve;                 // the curve that it is a facet of, by number
  std::vector<InferredPart> inferred = {};  // of a measured one
  std::optional<double> thickness = {};     // [m] of what is behind it, where that is known
};

}  // namespace scanworld
