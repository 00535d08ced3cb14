// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "drawn_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "error.h"
#include "world/convex_parts.h"
#include "world/solids.h"
#include "world/storeys.h"
#include "world/upright.h"

namespace scanworld {

namespace {

constexpr double kUpright = 0.2;      // of a normal's z: what is steeper is a wall
constexpr double kSame = 1e-6;        // [m] ends that are one
constexpr double kHeadroom = 2.0;     // [m] over the floor: obstacles above are not drawn
constexpr double kOutside = 0.5;      // [m] of the overall dimensions from the walls
constexpr double kBesideName = 0.35;  // [m] of a room's dimensions from its middle

// The vertices of a level cut through a closed convex mesh.
std::vector<Vec2> cut_of(const Mesh& mesh, double height) {
  std::vector<Vec2> points;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = [&](std::size_t c) -> const Vec3& {
        return mesh.vertices[static_cast<std::size_t>(t[c % 3])];
      };
      if (const auto at = crossing(corner(k), corner(k + 1), height)) points.push_back(*at);
    }
  return convex_hull(std::move(points));
}

// The lowest and the highest of some points, at least one.
std::pair<double, double> heights_of(const std::vector<Vec3>& points) {
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(), [](const Vec3& p, const Vec3& q) { return p.z() < q.z(); });
  return {low->z(), high->z()};
}

Mesh turned(Mesh mesh, const Eigen::Quaterniond& turn) {
  for (Vec3& v : mesh.vertices) v = turn * v;
  return mesh;
}

class Drawer {
 public:
  Drawer(const World& world, const DrawnPlanOptions& options)
      : world_(world), options_(options), upright_(world) {
    choose_storey();
    plan_.cut = plan_.level + options.cut;
  }

  DrawnPlan draw() && {
    add_walls();
    add_solids();
    add_openings();
    add_floors_and_rooms();
    find_main_direction();
    for (const Room& room : world_.rooms)
      if (is_here(room)) add_widths(room);
    add_overall();
    return std::move(plan_);
  }

 private:
  void choose_storey() {
    const std::vector<Storey> storeys = find_storeys(world_);
    plan_.level = main_level(world_);
    if (options_.storey) {
      if (*options_.storey < 0 || static_cast<std::size_t>(*options_.storey) >= storeys.size())
        throw Error(Cause::usage, fmt::format("--storey {}: the world has {}, the lowest is 0",
                                              *options_.storey, storeys.size()));
      plan_.level = storeys[static_cast<std::size_t>(*options_.storey)].level;
    }
    next_level_ = std::numeric_limits<double>::max();
    for (const Storey& s : storeys) {
      if (s.level > plan_.level + kSame) next_level_ = std::min(next_level_, s.level);
      if (std::abs(s.level - plan_.level) < kHeadroom) floors_ = s.floors;
    }
  }

  bool is_here(const Room& room) const {
    if (!room.center) return false;
    const double height = world_.frame.up.dot(*room.center);
    return height > plan_.level - kHeadroom / 2 && height < next_level_ - kHeadroom / 2;
  }

  // Pieces of one surface that go on in each other become one.
  void add_walls() {
    std::map<std::size_t, std::vector<WallCut>> by_surface;
    for (const WallCut& cut : cut_at(plan_.cut, upright_))
      if (std::abs(upright_.normals[cut.surface].z()) < 1 - kUpright)
        by_surface[cut.surface].push_back(cut);
    for (auto& [surface, cuts] : by_surface) {
      const Vec2 along(-cuts[0].front.y(), cuts[0].front.x());
      for (WallCut& c : cuts)
        if (along.dot(c.b - c.a) < 0) std::swap(c.a, c.b);
      std::sort(cuts.begin(), cuts.end(), [&](const WallCut& p, const WallCut& q) {
        return along.dot(p.a) < along.dot(q.a);
      });
      std::vector<DrawnPlan::Line> lines;
      for (const WallCut& c : cuts)
        if (!lines.empty() && (lines.back().b - c.a).norm() < kSame)
          lines.back().b = c.b;
        else
          lines.push_back({c.a, c.b});
      plan_.walls.insert(plan_.walls.end(), lines.begin(), lines.end());
    }
  }

  void add_solids() {
    for (const Collider& c : world_.colliders) {
      const Mesh mesh = std::visit([](const auto& shape) { return mesh_of(shape); }, c.shape);
      const Surface* of = find_surface(world_, c.surface);
      if (!of || of->kind == Kind::floor || of->kind == Kind::ceiling) continue;
      std::vector<Vec2> ring = cut_of(turned(mesh, upright_.turn), plan_.cut);
      if (ring.size() >= 3) plan_.solids.push_back(std::move(ring));
    }
    for (const Obstacle& o : world_.obstacles) {
      const Mesh mesh = turned(mesh_of(o, world_.frame), upright_.turn);
      std::vector<Vec2> points;
      for (const Vec3& v : mesh.vertices) points.push_back(v.head<2>());
      const auto [low, high] = heights_of(mesh.vertices);
      if (high > plan_.level && low < std::min(plan_.level + kHeadroom, next_level_))
        plan_.things.push_back(convex_hull(std::move(points)));
    }
  }

  void add_openings() {
    for (const Opening& o : world_.openings) {
      const std::vector<Vec3> ring = upright_.ring(o.loop);
      const auto [low, high] = heights_of(ring);
      if (high < plan_.level + 0.5 || low > std::min(plan_.level + 2.5, next_level_)) continue;
      const auto ends = ends_of(ring);
      plan_.openings.push_back({ends.first, ends.second, o.kind, o.width, o.glass});
    }
  }

  // The two points of an upright polygon that are farthest apart, seen from above.
  static std::pair<Vec2, Vec2> ends_of(const std::vector<Vec3>& ring) {
    std::pair<Vec2, Vec2> ends{ring[0].head<2>(), ring[0].head<2>()};
    for (const Vec3& p : ring)
      for (const Vec3& q : ring)
        if ((p - q).head<2>().norm() > (ends.first - ends.second).norm())
          ends = {p.head<2>(), q.head<2>()};
    return ends;
  }

  void add_floors_and_rooms() {
    for (int f : floors_) {
      const Surface& floor = world_.surfaces[static_cast<std::size_t>(f)];
      std::vector<std::vector<Vec2>> rings;
      const auto add = [&](const Loop& loop) {
        rings.emplace_back();
        for (const Vec3& v : upright_.ring(loop)) rings.back().push_back(v.head<2>());
      };
      add(floor.outer);
      for (const Loop& hole : floor.holes) add(hole);
      plan_.floors.push_back(std::move(rings));
    }
    for (const Room& room : world_.rooms)
      if (is_here(room))
        plan_.rooms.push_back({(upright_.turn * *room.center).head<2>(), room.name, room.area});
  }

  // The way of the wall that most others go along or across, by length.
  void find_main_direction() {
    constexpr double kAligned = 0.9998;  // cosine of a degree
    double most = 0;
    for (const DrawnPlan::Line& line : plan_.walls) {
      const Vec2 way = (line.b - line.a).normalized();
      double sum = 0;
      for (const DrawnPlan::Line& other : plan_.walls) {
        const Vec2 there = other.b - other.a;
        const double length = there.norm();
        const double cosine = std::abs(way.dot(there));
        if (std::max(cosine, std::sqrt(std::max(0.0, length * length - cosine * cosine))) >
            kAligned * length)
          sum += length;
      }
      if (sum > most + kSame) most = sum, plan_.along = way;
    }
    // Of the four ways the one nearest to x, so that text reads from below.
    if (std::abs(plan_.along.x()) < std::abs(plan_.along.y()))
      plan_.along = Vec2(-plan_.along.y(), plan_.along.x());
    if (plan_.along.x() < 0) plan_.along = -plan_.along;
  }

  // How far it is from a place to the wall of a room that is met first, its openings taken as
  // closed, at the height of the cut.
  std::optional<double> distance_to_wall(const Room& room, const Vec2& from,
                                         const Vec2& way) const {
    std::optional<double> nearest;
    for (int id : room.surfaces) {
      const Surface* s = find_surface(world_, id);
      if (!s || s->kind != Kind::wall) continue;
      const Vec3 normal = upright_.turn * s->plane.normal;
      const double approach = -normal.head<2>().dot(way);
      if (approach < 0.1) continue;  // along it, or from behind
      const double over = normal.dot(Vec3(from.x(), from.y(), plan_.cut)) + s->plane.offset;
      const double distance = over / approach;
      if (over < 0 || (nearest && distance >= *nearest)) continue;
      const auto [a, b] = ends_of(upright_.ring(s->outer));
      const Vec2 met = from + distance * way;
      if ((met - a).dot(b - a) < 0 || (met - b).dot(a - b) < 0) continue;
      nearest = distance;
    }
    return nearest;
  }

  // From wall to wall, along and across, a little beside the room's middle, where its name is.
  void add_widths(const Room& room) {
    const Vec2 middle = (upright_.turn * *room.center).head<2>();
    const Vec2 across(-plan_.along.y(), plan_.along.x());
    for (const auto& [way, aside] : {std::pair<Vec2, Vec2>(plan_.along, -across),
                                     std::pair<Vec2, Vec2>(across, -2 * plan_.along)}) {
      const Vec2 from = middle + kBesideName * aside;
      const auto ahead = distance_to_wall(room, from, way),
                 back = distance_to_wall(room, from, -way);
      if (ahead && back && *ahead + *back >= options_.min_room)
        plan_.widths.push_back({from - *back * way, from + *ahead * way});
    }
  }

  void add_overall() {
    if (plan_.walls.empty()) return;
    const Vec2 across(-plan_.along.y(), plan_.along.x());
    Eigen::AlignedBox2d box;
    for (const DrawnPlan::Line& line : plan_.walls)
      for (const Vec2& p : {line.a, line.b}) box.extend(Vec2(plan_.along.dot(p), across.dot(p)));
    for (const auto& ring : plan_.solids)
      for (const Vec2& p : ring) box.extend(Vec2(plan_.along.dot(p), across.dot(p)));
    const auto at = [&](double x, double y) -> Vec2 { return x * plan_.along + y * across; };
    const double below = box.min().y() - kOutside, left = box.min().x() - kOutside;
    plan_.overall.push_back({at(box.min().x(), below), at(box.max().x(), below)});
    plan_.overall.push_back({at(left, box.min().y()), at(left, box.max().y())});
  }

  const World& world_;
  const DrawnPlanOptions& options_;
  const Upright upright_;
  double next_level_ = 0;    // of the storey above
  std::vector<int> floors_;  // indices of surfaces
  DrawnPlan plan_;
};

}  // namespace

DrawnPlan draw_plan(const World& world, const DrawnPlanOptions& options) {
  return Drawer(world, options).draw();
}

}  // namespace scanworld
