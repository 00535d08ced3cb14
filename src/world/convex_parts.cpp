// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "convex_parts.h"

#include <algorithm>
#include <map>

#include "../disjoint_sets.h"
#include "../polygon.h"

namespace scanworld {

namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// A ring without the corners that are nearly straight. Those before and after one that is left out
// are kept apart by it, so that errors don't add up.
std::vector<Vec2> straightened(const std::vector<Vec2>& ring, double tolerance) {
  std::vector<Vec2> kept;
  std::vector<Vec2> dropped;  // since the last that was kept
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2& next = ring[(i + 1) % ring.size()];
    const Vec2& last = kept.empty() ? ring.back() : kept.back();
    dropped.push_back(ring[i]);
    const bool straight = std::all_of(dropped.begin(), dropped.end(), [&](const Vec2& p) {
      return distance_to(p, last, next) <= tolerance;
    });
    if (straight) continue;
    kept.push_back(ring[i]);
    dropped.clear();
  }
  return kept.size() < 3 ? ring : kept;
}

geos::Rings straightened(const geos::Rings& polygon, double tolerance) {
  geos::Rings rings;
  for (const auto& ring : polygon) rings.push_back(straightened(ring, tolerance));
  return geos::why_invalid(rings) ? polygon : rings;
}

// An edge that two triangles share.
struct Diagonal {
  std::size_t a, b;
  double length;
};

std::vector<Diagonal> diagonals_of(const std::vector<std::array<Vec2, 3>>& triangles) {
  const auto less = [](const Vec2& p, const Vec2& q) {
    return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
  };
  using Ends = std::array<double, 4>;
  std::map<Ends, std::size_t> first;
  std::vector<Diagonal> diagonals;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 &p = triangles[t][k], &q = triangles[t][(k + 1) % 3];
      const Ends ends =
          less(p, q) ? Ends{p.x(), p.y(), q.x(), q.y()} : Ends{q.x(), q.y(), p.x(), p.y()};
      const auto [found, is_new] = first.try_emplace(ends, t);
      if (!is_new) diagonals.push_back({found->second, t, (q - p).norm()});
    }
  std::stable_sort(diagonals.begin(), diagonals.end(),
                   [](const Diagonal& a, const Diagonal& b) { return a.length > b.length; });
  return diagonals;
}

}  // namespace

std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  if (points.empty()) return {};
  std::sort(points.begin(), points.end(), [](const Vec2& p, const Vec2& q) {
    return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
  });
  std::vector<Vec2> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= start + 2 &&
             cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

std::vector<std::vector<Vec2>> convex_parts(const geos::Rings& polygon, double tolerance) {
  const auto triangles = geos::triangulate(straightened(polygon, tolerance / 2));
  if (!triangles) return {};
  struct ConvexPart {
    std::vector<Vec2> corners;   // of its hull
    std::vector<Vec2> vertices;  // of its triangles: all of them are on the polygon's outline
  };
  std::vector<ConvexPart> parts;
  for (const auto& t : *triangles) parts.push_back({{t.begin(), t.end()}, {t.begin(), t.end()}});
  DisjointSets sets(parts.size());
  const std::vector<Diagonal> diagonals = diagonals_of(*triangles);
  for (bool changed = true; changed;) {
    changed = false;
    for (const Diagonal& d : diagonals) {
      const std::uint32_t a = sets.find(d.a), b = sets.find(d.b);
      if (a == b) continue;
      ConvexPart both{parts[a].corners, parts[a].vertices};
      both.corners.insert(both.corners.end(), parts[b].corners.begin(), parts[b].corners.end());
      both.corners = convex_hull(std::move(both.corners));
      both.vertices.insert(both.vertices.end(), parts[b].vertices.begin(), parts[b].vertices.end());
      if (!std::all_of(both.vertices.begin(), both.vertices.end(), [&](const Vec2& p) {
            return distance_to_ring(p, both.corners) <= tolerance / 2;
          }))
        continue;
      sets.unite(a, b);
      parts[sets.find(a)] = std::move(both);
      changed = true;
    }
  }
  std::vector<std::vector<Vec2>> result;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (sets.find(i) == i) result.push_back(std::move(parts[i].corners));
  return result;
}

}  // namespace scanworld
