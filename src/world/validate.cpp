// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "../polygon.h"
#include "geos.h"
#include "hull_volume.h"
#include "surface_rings.h"

namespace scanworld {

namespace {

constexpr double kUnitTolerance = 1e-6;  // of a direction's length
constexpr double kFlat = 1e-9;           // of the cube of a hull's size: what is no volume

class Validator {
 public:
  explicit Validator(const World& world) : world_(world) {}

  std::vector<std::string> run() {
    check_frame();
    for (std::size_t i = 0; i < world_.vertices.size(); ++i)
      check_place(fmt::format("vertex {}", i), world_.vertices[i]);
    surface_ids_ = check_ids("surface", world_.surfaces);
    const std::set<int> openings = check_ids("opening", world_.openings);
    const std::set<int> rooms = check_ids("room", world_.rooms);
    check_ids("obstacle", world_.obstacles);
    check_ids("way", world_.ways);
    const std::set<int> curves = check_ids("curve", world_.curves);
    for (const CurvedPart& c : world_.curves) check(c);
    const auto check_curve_id = [&](const char* what, int id, std::optional<int> curve) {
      if (curve && !curves.count(*curve)) report("{} {}: there is no curve {}", what, id, *curve);
    };
    for (const Surface& s : world_.surfaces) check_curve_id("surface", s.id, s.curve);
    for (const Obstacle& o : world_.obstacles) check_curve_id("obstacle", o.id, o.curve);
    for (const Surface& s : world_.surfaces) check(s);
    for (const Opening& o : world_.openings) check(o);
    for (const Obstacle& o : world_.obstacles) {
      const std::string name = fmt::format("obstacle {}", o.id);
      std::visit([&](const auto& shape) { check_shape(name, shape); }, o.shape);
    }
    for (std::size_t i = 0; i < world_.colliders.size(); ++i) {
      const Collider& c = world_.colliders[i];
      const std::string name = fmt::format("collider {}", i);
      check_surface_id(name, c.surface);
      std::visit([&](const auto& shape) { check_shape(name, shape); }, c.shape);
    }
    for (const Room& r : world_.rooms) check(r);
    for (std::size_t i = 0; i < world_.doors.size(); ++i) {
      const Door& d = world_.doors[i];
      if (!openings.count(d.opening)) report("door {}: there is no opening {}", i, d.opening);
      for (int id : d.rooms)
        if (!rooms.count(id)) report("door {}: there is no room {}", i, id);
      if (d.rooms[0] == d.rooms[1]) report("door {}: joins room {} with itself", i, d.rooms[0]);
    }
    for (const Way& w : world_.ways) check(w, rooms);
    return std::move(reasons_);
  }

 private:
  template <typename... Values>
  void report(fmt::format_string<Values...> text, Values&&... values) {
    reasons_.push_back(fmt::format(text, std::forward<Values>(values)...));
  }

  template <typename Item>
  std::set<int> check_ids(const char* what, const std::vector<Item>& items) {
    std::set<int> ids;
    for (const Item& item : items) {
      if (item.id < 0) report("{} {}: the id is negative", what, item.id);
      if (!ids.insert(item.id).second) report("{} {}: the id is there twice", what, item.id);
    }
    return ids;
  }

  void check_surface_id(const std::string& name, int id) {
    if (!surface_ids_.count(id)) report("{}: there is no surface {}", name, id);
  }

  // True where a place is in the world.
  bool check_place(const std::string& name, const Vec3& p) {
    if (!p.allFinite()) return report("{} is not finite", name), false;
    if (const double far = p.cwiseAbs().maxCoeff(); far > kWorldReach)
      return report("{} is {:.6g} m from the origin, more than {}", name, far, kWorldReach), false;
    return true;
  }

  void check_size(const std::string& name, const char* what, double size) {
    if (!(size > 0))
      report("{}: the {} {} is not positive", name, what, size);
    else if (size > 2 * kWorldReach)
      report("{}: the {} {:.6g} is more than {} m", name, what, size, 2 * kWorldReach);
  }

  void check_frame() {
    if (!(world_.frame.origin.cwiseAbs().maxCoeff() < kFarthest))
      report("frame: the origin is not within {:.0f} m", kFarthest);
    if (!is_unit(world_.frame.up)) report("frame: up is not of length 1");
    if (!is_unit(world_.frame.rotation)) report("frame: the rotation is not of length 1");
  }

  template <typename T>  // a vector or a rotation
  static bool is_unit(const T& v) {
    return std::abs(v.norm() - 1) < kUnitTolerance;
  }

  void check(const CurvedPart& part) {
    const std::string name = fmt::format("curve {}", part.id);
    const Curve& c = part.curve;
    if (!c.shape.point.allFinite()) report("{}: the point is not finite", name);
    if (!is_unit(c.shape.axis)) return report("{}: the axis is not of length 1", name);
    if (!is_unit(c.start) || std::abs(c.start.dot(c.shape.axis)) > kUnitTolerance)
      report("{}: the start is not of length 1 across the axis", name);
    if (c.shape.type == CurveType::cone) {
      if (!(c.shape.half_angle > 0 && c.shape.half_angle < M_PI / 2))
        report("{}: the half angle {} is not from 0 to pi / 2", name, c.shape.half_angle);
      if (!(c.low >= 0)) report("{}: the extent begins at {}, before the apex", name, c.low);
    } else if (!(c.shape.radius > 0 && std::isfinite(c.shape.radius))) {
      report("{}: the radius {} is not positive", name, c.shape.radius);
    }
    if (!(c.high > c.low && std::isfinite(c.high - c.low)))
      report("{}: the extent {} to {} is none", name, c.low, c.high);
    if (!(c.sweep > 0 && c.sweep < 2 * M_PI + kUnitTolerance))
      report("{}: the sweep {} is not from 0 to 2 pi", name, c.sweep);
  }

  void check(const Room& r) {
    const std::string name = fmt::format("room {}", r.id);
    for (int id : r.surfaces) check_surface_id(name, id);
    const auto check_size = [&](const char* what, std::optional<double> size) {
      if (size && !(*size > 0 && std::isfinite(*size)))
        report("{}: the {} {} is not positive", name, what, *size);
    };
    check_size("area", r.area), check_size("height", r.height), check_size("volume", r.volume);
    if (r.center) check_place(name + ": the center", *r.center);
  }

  void check(const std::string& name, const Leaf& leaf) {
    check_surface_id(name + ": the leaf", leaf.surface);
    if (!(leaf.angle >= 0 && leaf.angle <= M_PI))
      report("{}: the leaf's angle {} is not from 0 to pi", name, leaf.angle);
  }

  void check(const Way& w, const std::set<int>& rooms) {
    const std::string name = fmt::format("way {}", w.id);
    check_place(name + ": the foot", w.foot);
    check_place(name + ": the top", w.top);
    check_size(name, "width", w.width);
    check_size(name, "rise", world_.frame.up.dot(w.top - w.foot));
    if (w.kind == WayKind::stairs) {
      check_size(name, "riser", w.riser);
      check_size(name, "tread", w.tread);
      if (w.steps < 2) report("{}: stairs of {} steps", name, w.steps);
    } else {
      check_size(name, "slope", w.slope);
    }
    for (const std::optional<int>& id : w.floors)
      if (id) check_surface_id(name, *id);
    for (const std::optional<int>& id : w.rooms)
      if (id && !rooms.count(*id)) report("{}: there is no room {}", name, *id);
  }

  void check(const Surface& s) {
    const std::string name = fmt::format("surface {}", s.id);
    if (!is_unit(s.plane.normal)) return report("{}: the normal is not of length 1", name);
    if (!std::isfinite(s.plane.offset)) return report("{}: the plane's offset is not finite", name);
    if (s.thickness && !(*s.thickness > 0))
      report("{}: the thickness {} is not positive", name, *s.thickness);
    if (!(s.support.rms >= 0)) report("{}: the rms {} is negative", name, s.support.rms);
    if (!(s.support.coverage >= 0 && s.support.coverage <= 1))
      report("{}: the coverage {} is not from 0 to 1", name, s.support.coverage);
    bool sound = check_loop(name, "outer", s.outer, s.plane);
    for (std::size_t h = 0; h < s.holes.size(); ++h)
      sound &= check_loop(name, fmt::format("hole {}", h), s.holes[h], s.plane);
    for (const InferredPart& part : s.inferred) check_inferred(name, part, s.plane);
    if (!sound) return;
    const geos::Rings rings = rings_of(world_, s);
    if (doubled_area(rings[0]) <= 0) report("{}: the outer loop is not counter-clockwise", name);
    for (std::size_t h = 1; h < rings.size(); ++h)
      if (doubled_area(rings[h]) >= 0) report("{}: hole {} is not clockwise", name, h - 1);
    if (const auto why = geos::why_invalid(rings)) report("{}: {}", name, *why);
  }

  void check_inferred(const std::string& name, const InferredPart& part, const Plane& plane) {
    const auto check_ring = [&](const std::vector<Vec3>& ring) {
      if (ring.size() < 3)
        report("{}: a ring of an inferred part has {} points", name, ring.size());
      if (!check_places(name + ": an inferred part", ring)) return;
      for (const Vec3& v : ring)
        if (const double off = std::abs(plane.signed_distance(v)); off > kPlanarTolerance)
          report("{}: a point of an inferred part is {:.4f} m off the plane", name, off);
    };
    check_ring(part.outer);
    for (const auto& hole : part.holes) check_ring(hole);
  }

  // True where the loop's vertices exist, are different and lie in the plane.
  bool check_loop(const std::string& name, const std::string& loop_name, const Loop& loop,
                  const Plane& plane) {
    if (loop.size() < 3)
      return report("{}: {} has {} vertices", name, loop_name, loop.size()), false;
    std::set<int> seen;
    bool sound = true;
    for (int index : loop) {
      if (index < 0 || static_cast<std::size_t>(index) >= world_.vertices.size())
        return report("{}: {} has the vertex {}, but there are {}", name, loop_name, index,
                      world_.vertices.size()),
               false;
      if (!seen.insert(index).second)
        report("{}: {} has the vertex {} twice", name, loop_name, index), sound = false;
      const Vec3& v = world_.vertices[static_cast<std::size_t>(index)];
      const double off = std::abs(plane.signed_distance(v));
      if (!v.allFinite() || v.cwiseAbs().maxCoeff() > kWorldReach)
        sound = false;  // as told
      else if (off > kPlanarTolerance)
        report("{}: vertex {} of {} is {:.4f} m off the plane", name, index, loop_name, off),
            sound = false;
    }
    return sound;
  }

  void check(const Opening& o) {
    const std::string name = fmt::format("opening {}", o.id);
    check_size(name, "width", o.width);
    check_size(name, "height", o.height);
    if (o.leaf) check(name, *o.leaf);
    const Surface* surface = find_surface(world_, o.surface);
    if (!surface) return check_surface_id(name, o.surface);
    if (!check_loop(name, "the loop", o.loop, surface->plane)) return;
    if (const auto why = geos::why_invalid({ring_of(world_, o.loop, frame_of(surface->plane))}))
      report("{}: {}", name, *why);
  }

  void check_shape(const std::string& name, const OrientedBox& b) {
    check_place(name + ": the center", b.center);
    for (double size : b.size) check_size(name, "size", size);
    if (!is_unit(b.rotation)) report("{}: the rotation is not of length 1", name);
  }
  void check_shape(const std::string& name, const ConvexHull& h) {
    const std::size_t count = h.vertices.size();
    if (count < 4) return report("{}: the hull has {} vertices", name, count);
    Box3 box;
    for (const Vec3& v : h.vertices) box.extend(v);
    if (check_places(name, h.vertices) &&
        !(hull_volume(h.vertices) > kFlat * std::pow(box.sizes().maxCoeff(), 3)))
      report("{}: the hull of {} vertices has no volume", name, count);
  }
  void check_shape(const std::string& name, const Cylinder& c) {
    check_place(name + ": the center", c.center);
    check_size(name, "radius", c.radius);
    check_size(name, "height", c.height);
  }
  void check_shape(const std::string& name, const ConvexPrism& p) {
    if (p.base.size() < 3) return report("{}: the base has {} vertices", name, p.base.size());
    if (!check_places(name, p.base) || !check_place(name + ": the extrusion", p.extrusion)) return;
    if (!(p.extrusion.norm() > 0)) report("{}: the extrusion has no length", name);
    check_convex(name, p);
  }
  void check_convex(const std::string& name, const ConvexPrism& p) {
    const std::size_t n = p.base.size();
    const Vec3 sum = doubled_area(p.base);
    if (!(sum.norm() > 0)) return report("{}: the base has no area", name);
    const Vec3 normal = sum.normalized();
    if (!(std::abs(normal.dot(p.extrusion)) > 0))
      report("{}: the extrusion lies in the base", name);
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 &a = p.base[i], &b = p.base[(i + 1) % n], &c = p.base[(i + 2) % n];
      if (std::abs(normal.dot(a - p.base[0])) > kPlanarTolerance)
        report("{}: vertex {} of the base is off its plane", name, i);
      if (normal.dot((b - a).cross(c - b)) < -kPlanarTolerance * (c - a).norm())
        report("{}: the base is not convex at vertex {}", name, (i + 1) % n);
    }
  }
  bool check_places(const std::string& name, const std::vector<Vec3>& points) {
    bool sound = true;
    for (std::size_t i = 0; i < points.size(); ++i)
      sound &= check_place(fmt::format("{}: vertex {}", name, i), points[i]);
    return sound;
  }

  const World& world_;
  std::set<int> surface_ids_;
  std::vector<std::string> reasons_;
};

}  // namespace

std::vector<std::string> validate(const World& world) { return Validator(world).run(); }

}  // namespace scanworld
