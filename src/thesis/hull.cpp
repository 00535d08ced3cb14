// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "hull.h"

#include <algorithm>

namespace scanworld::thesis {

namespace {

constexpr double kRounding =
    1e-9;  // [m] far below any noise, far above the rounding of coordinates up to 1 km

// On the line through `a` and `b` and not between them.
bool is_beyond(const Vec3& p, const Vec3& a, const Vec3& b) { return (p - a).dot(p - b) > 0; }

// Two points so far, and a third that is on their line: keeps the two that are farthest apart.
void stretch(std::vector<Vec3>& pair, const Vec3& p) {
  if (!is_beyond(p, pair[0], pair[1])) return;
  ((p - pair[0]).squaredNorm() > (p - pair[1]).squaredNorm() ? pair[1] : pair[0]) = p;
}

void drop_collinear(std::vector<Vec3>& hull, const Vec3& normal) {
  for (std::size_t i = 0; hull.size() > 2 && i < hull.size();) {
    const Vec3& before = hull[(i + hull.size() - 1) % hull.size()];
    const Vec3& after = hull[(i + 1) % hull.size()];
    if (is_seeing(hull[i], before, after, normal))
      ++i;
    else
      hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace

bool is_seeing(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& normal) {
  const Vec3 outward = (b - a).cross(normal);
  return outward.dot(p - a) > kRounding * outward.norm();
}

std::vector<Vec3> convex_hull(const std::vector<Vec3>& points, const Vec3& normal) {
  std::vector<Vec3> hull;
  std::vector<char> visible;
  for (const Vec3& p : points) {
    if (hull.size() < 2) {
      if (hull.empty() || (p - hull[0]).norm() > kRounding) hull.push_back(p);
      continue;
    }
    const std::size_t n = hull.size();
    visible.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      visible[i] = is_seeing(p, hull[i], hull[(i + 1) % n], normal);
    const auto any = std::find(visible.begin(), visible.end(), 1);
    if (any == visible.end()) {
      if (n == 2) stretch(hull, p);
      continue;
    }
    // The edges that p sees follow each other. Those from `first` on, up to the one before `last`,
    // are replaced by the edges from `first` to p and from p to `last`.
    std::size_t first = static_cast<std::size_t>(any - visible.begin());
    while (visible[(first + n - 1) % n]) first = (first + n - 1) % n;
    std::size_t last = (first + 1) % n;
    while (visible[last] && last != first) last = (last + 1) % n;
    std::vector<Vec3> next = {hull[first], p};
    for (std::size_t i = last; i != first; i = (i + 1) % n) next.push_back(hull[i]);
    hull.swap(next);
  }
  drop_collinear(hull, normal);
  return hull;
}

}  // namespace scanworld::thesis
