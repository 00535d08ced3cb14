// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "types.h"

namespace scanworld {

// The angle to the x axis of the way along which points spread most [rad].
inline double principal_angle(const std::vector<Vec2>& points) {
  Vec2 mean = Vec2::Zero();
  for (const Vec2& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  double xx = 0, xy = 0, yy = 0;
  for (const Vec2& p : points) {
    const Vec2 q = p - mean;
    xx += q.x() * q.x(), xy += q.x() * q.y(), yy += q.y() * q.y();
  }
  return 0.5 * std::atan2(2 * xy, xx - yy);
}

// Twice the signed area of a ring: positive where it is counter-clockwise.
inline double doubled_area(const std::vector<Vec2>& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &p = ring[i], &q = ring[(i + 1) % ring.size()];
    sum += p.x() * q.y() - p.y() * q.x();
  }
  return sum;
}

// The same of a ring in space, as a vector along its normal.
inline Vec3 doubled_area(const std::vector<Vec3>& ring) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    sum += (ring[i] - ring[0]).cross(ring[i + 1] - ring[0]);
  return sum;
}

// Whether a point is in a polygon, whose holes are loops as well: by the number of edges to its
// right (the even-odd rule).
inline bool is_inside(const std::vector<std::vector<Vec2>>& loops, const Vec2& p) {
  bool inside = false;
  for (const auto& loop : loops)
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
      const Vec2 &a = loop[i], &b = loop[j];
      if ((a.y() > p.y()) != (b.y() > p.y()) &&
          p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
        inside = !inside;
    }
  return inside;
}

// The place on a segment that is nearest to a point.
inline Vec2 nearest_on(const Vec2& p, const Vec2& a, const Vec2& b) {
  const double length2 = (b - a).squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) : 0;
  return a + t * (b - a);
}

// The square with edges of this length, of all in the plane, that a point is in.
inline std::pair<int, int> square_of(const Vec2& p, double edge) {
  const Vec2 at = p / edge;
  return {static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y()))};
}

// How far a point is from a segment.
inline double distance_to(const Vec2& p, const Vec2& a, const Vec2& b) {
  return (nearest_on(p, a, b) - p).norm();
}

// Whether two segments cross, each the other's inside.
inline bool do_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto side = [](const Vec2& p, const Vec2& q, const Vec2& r) {
    return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
  };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

inline double distance_to_ring(const Vec2& p, const std::vector<Vec2>& ring) {
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < ring.size(); ++i)
    least = std::min(least, distance_to(p, ring[i], ring[(i + 1) % ring.size()]));
  return least;
}

// What a line leaves of a convex ring: the points with normal * p <= offset (Sutherland and Hodgman
// 1974).
template <typename Point>
std::vector<Point> clipped(const std::vector<Point>& ring, const Point& normal, double offset) {
  std::vector<Point> left;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double over_a = normal.dot(a) - offset, over_b = normal.dot(b) - offset;
    if (over_a <= 0) left.push_back(a);
    if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0))
      left.push_back(a + (b - a) * (over_a / (over_a - over_b)));
  }
  return left;
}

}  // namespace scanworld
