// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geos.h"
#include "surface_rings.h"

namespace scanworld {

namespace {

constexpr double kUnitTolerance = 1e-6;  // of a direction's length

class Validator {
 public:
  explicit Validator(const World& world) : world_(world) {}

  std::vector<std::string> run() {
    check_frame();
    for (std::size_t i = 0; i < world_.vertices.size(); ++i)
      if (!world_.vertices[i].allFinite()) report("vertex {} is not finite", i);
    surface_ids_ = check_ids("surface", world_.surfaces);
    const std::set<int> openings = check_ids("opening", world_.openings);
    const std::set<int> rooms = check_ids("room", world_.rooms);
    check_ids("obstacle", world_.obstacles);
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
    }
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

  void check_frame() {
    if (!world_.frame.origin.allFinite()) report("frame: the origin is not finite");
    if (!is_unit(world_.frame.up)) report("frame: up is not of length 1");
    if (!is_unit(world_.frame.rotation)) report("frame: the rotation is not of length 1");
  }

  template <typename T>  // a vector or a rotation
  static bool is_unit(const T& v) {
    return std::abs(v.norm() - 1) < kUnitTolerance;
  }

  void check(const Room& r) {
    const std::string name = fmt::format("room {}", r.id);
    for (int id : r.surfaces) check_surface_id(name, id);
    if (r.area && !(*r.area > 0 && std::isfinite(*r.area)))
      report("{}: the area {} is not positive", name, *r.area);
    if (r.center && !r.center->allFinite()) report("{}: the center is not finite", name);
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
    if (!sound) return;
    const geos::Rings rings = rings_of(world_, s);
    if (doubled_area(rings[0]) <= 0) report("{}: the outer loop is not counter-clockwise", name);
    for (std::size_t h = 1; h < rings.size(); ++h)
      if (doubled_area(rings[h]) >= 0) report("{}: hole {} is not clockwise", name, h - 1);
    if (const auto why = geos::why_invalid(rings)) report("{}: {}", name, *why);
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
      if (!v.allFinite())
        sound = false;
      else if (off > kPlanarTolerance)
        report("{}: vertex {} of {} is {:.4f} m off the plane", name, index, loop_name, off),
            sound = false;
    }
    return sound;
  }

  void check(const Opening& o) {
    const std::string name = fmt::format("opening {}", o.id);
    if (!(o.width > 0) || !(o.height > 0))
      report("{}: the size {} x {} is not positive", name, o.width, o.height);
    const Surface* surface = find_surface(world_, o.surface);
    if (!surface) return check_surface_id(name, o.surface);
    check_loop(name, "the loop", o.loop, surface->plane);
  }

  void check_shape(const std::string& name, const OrientedBox& b) {
    if (!b.center.allFinite()) report("{}: the center is not finite", name);
    if (!(b.size.array() > 0).all() || !b.size.allFinite())
      report("{}: the size {} {} {} is not positive", name, b.size.x(), b.size.y(), b.size.z());
    if (!is_unit(b.rotation)) report("{}: the rotation is not of length 1", name);
  }
  void check_shape(const std::string& name, const ConvexHull& h) {
    if (h.vertices.size() < 4) report("{}: the hull has {} vertices", name, h.vertices.size());
    check_finite(name, h.vertices);
  }
  void check_shape(const std::string& name, const Cylinder& c) {
    if (!c.center.allFinite()) report("{}: the center is not finite", name);
    if (!(c.radius > 0) || !(c.height > 0))
      report("{}: the size {} x {} is not positive", name, c.radius, c.height);
  }
  void check_shape(const std::string& name, const ConvexPrism& p) {
    if (p.base.size() < 3) report("{}: the base has {} vertices", name, p.base.size());
    check_finite(name, p.base);
    if (!(p.extrusion.norm() > 0)) report("{}: the extrusion has no length", name);
    check_convex(name, p);
  }
  void check_convex(const std::string& name, const ConvexPrism& p) {
    const std::size_t n = p.base.size();
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < n; ++i)
      sum += (p.base[i] - p.base[0]).cross(p.base[i + 1] - p.base[0]);
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
  void check_finite(const std::string& name, const std::vector<Vec3>& points) {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!points[i].allFinite()) report("{}: vertex {} is not finite", name, i);
  }

  const World& world_;
  std::set<int> surface_ids_;
  std::vector<std::string> reasons_;
};

}  // namespace

std::vector<std::string> validate(const World& world) { return Validator(world).run(); }

}  // namespace scanworld
