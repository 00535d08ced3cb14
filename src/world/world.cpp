// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world.h"

#include <algorithm>

namespace scanworld {

namespace {

// Twice the area that a loop goes around, as a vector along its normal.
Vec3 doubled_area(const World& world, const Loop& loop) {
  Vec3 sum = Vec3::Zero();
  const auto at = [&](std::size_t i) {
    return world.vertices[static_cast<std::size_t>(loop[i % loop.size()])];
  };
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) sum += (at(i) - at(0)).cross(at(i + 1) - at(0));
  return sum;
}

void extend(Box3& box, const OrientedBox& b) {
  const Vec3 reach = b.rotation.toRotationMatrix().cwiseAbs() * b.size / 2;
  box.extend(b.center - reach).extend(Vec3(b.center + reach));
}
void extend(Box3& box, const ConvexHull& h) {
  for (const Vec3& v : h.vertices) box.extend(v);
}

}  // namespace

const char* name_of(Kind kind) {
  static constexpr const char* names[] = {"floor", "ceiling", "wall", "other"};
  return names[static_cast<int>(kind)];
}

const char* name_of(Source source) {
  static constexpr const char* names[] = {"measured", "inferred"};
  return names[static_cast<int>(source)];
}

const char* name_of(CurveType type) {
  static constexpr const char* names[] = {"cylinder", "sphere", "cone"};
  return names[static_cast<int>(type)];
}

const char* name_of(OpeningKind kind) {
  static constexpr const char* names[] = {"door", "window", "passage"};
  return names[static_cast<int>(kind)];
}

const char* name_of(LeafHinge hinge) {
  static constexpr const char* names[] = {"left", "right"};
  return names[static_cast<int>(hinge)];
}

const char* name_of(LeafSide side) {
  static constexpr const char* names[] = {"front", "back"};
  return names[static_cast<int>(side)];
}

const char* name_of(WayKind kind) {
  static constexpr const char* names[] = {"stairs", "ramp"};
  return names[static_cast<int>(kind)];
}

std::size_t triangle_count(const World& world) {
  std::size_t count = 0;
  for (const Surface& s : world.surfaces) {
    count += s.outer.size() - 2;
    for (const Loop& hole : s.holes) count += hole.size() + 2;
  }
  return count;
}

int next_id(const World& world) {
  int next = 0;
  for (const Surface& s : world.surfaces) next = std::max(next, s.id + 1);
  return next;
}

const Surface* find_surface(const World& world, int id) {
  const auto found = std::find_if(world.surfaces.begin(), world.surfaces.end(),
                                  [&](const Surface& s) { return s.id == id; });
  return found == world.surfaces.end() ? nullptr : &*found;
}

double area(const World& world, const Surface& surface) {
  Vec3 sum = doubled_area(world, surface.outer);
  for (const Loop& hole : surface.holes) sum += doubled_area(world, hole);
  return sum.dot(surface.plane.normal) / 2;
}

Vec3 centroid(const World& world, const Surface& surface) {
  const auto at = [&](int index) { return world.vertices[static_cast<std::size_t>(index)]; };
  const Vec3 origin = at(surface.outer[0]);
  Vec3 sum = Vec3::Zero();
  double weight = 0;
  // Fans of triangles, whose areas are negative where a loop turns back, and in holes.
  const auto add = [&](const Loop& loop) {
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      const Vec3 a = at(loop[0]) - origin, b = at(loop[i]) - origin, c = at(loop[i + 1]) - origin;
      const double w = (b - a).cross(c - a).dot(surface.plane.normal);
      sum += w * (a + b + c) / 3, weight += w;
    }
  };
  add(surface.outer);
  for (const Loop& hole : surface.holes) add(hole);
  return origin + sum / weight;
}

Box3 bounds(const World& world) {
  Box3 box;
  for (const Vec3& v : world.vertices) box.extend(v);
  for (const Obstacle& obstacle : world.obstacles) {
    if (const auto* b = std::get_if<OrientedBox>(&obstacle.shape)) extend(box, *b);
    if (const auto* h = std::get_if<ConvexHull>(&obstacle.shape)) extend(box, *h);
    if (const auto* c = std::get_if<Cylinder>(&obstacle.shape)) {
      // A disc reaches less far along an axis the less that lies in it.
      const Vec3& up = world.frame.up;
      const Vec3 half = up * c->height / 2, r = c->radius * (1 - up.array().square()).max(0).sqrt();
      box.extend(c->center - half - r).extend(c->center - half + r);
      box.extend(c->center + half - r).extend(c->center + half + r);
    }
  }
  return box;
}

}  // namespace scanworld
