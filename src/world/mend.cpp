// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "mend.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "../error.h"
#include "../parallel.h"
#include "assemble.h"
#include "simplify.h"
#include "surface_rings.h"
#include "triangulate.h"
#include "validate.h"

namespace scanworld {

namespace {

constexpr double kNeck = 0.005;  // [m] where a polygon is narrower it is cut, if nothing else helps
constexpr double kLeastPart = 0.01;  // of the largest part's area; what is smaller is left out

// A world of one surface and its vertices.
World alone(const World& world, Surface surface) {
  World part{.frame = world.frame};
  std::map<int, int> index;
  const auto take = [&](Loop& loop) {
    for (int& v : loop) {
      const auto [found, is_new] = index.try_emplace(v, static_cast<int>(part.vertices.size()));
      if (is_new) part.vertices.push_back(world.vertices[static_cast<std::size_t>(v)]);
      v = found->second;
    }
  };
  take(surface.outer);
  for (Loop& hole : surface.holes) take(hole);
  surface.curve.reset();  // the curve is not there
  part.surfaces.push_back(std::move(surface));
  return part;
}

// Why a world cannot be kept as it is.
std::optional<std::string> fault_of(const World& world) {
  if (const auto reasons = validate(world); !reasons.empty()) return reasons[0];
  try {
    triangulate(world);
  } catch (const Error& error) {
    return error.what();
  }
  return std::nullopt;
}

// A reason without the name of the thing before it, which may be called otherwise in the end.
std::string unnamed(const std::string& reason) {
  const std::size_t colon = reason.find(": ");
  return colon == std::string::npos ? reason : reason.substr(colon + 2);
}

std::string in_scan(const World& world, const Vec3& p) {
  const Vec3 at = world.frame.to_scan(p);
  return fmt::format("({:.3f}, {:.3f}, {:.3f})", at.x(), at.y(), at.z());
}

Vec3 middle_of(const std::vector<Vec3>& points) {
  Box3 box;
  for (const Vec3& p : points) box.extend(p);
  return points.empty() ? Vec3(Vec3::Zero()) : box.center();
}

Vec3 middle_of(const World& world, const Loop& loop) {
  std::vector<Vec3> corners;
  for (int v : loop) corners.push_back(world.vertices[static_cast<std::size_t>(v)]);
  return middle_of(corners);
}

// Makes surfaces of the polygons in the plane of a broken one.
class Mender {
 public:
  Mender(World& world, const Surface& broken) : world_(world), broken_(broken) {
    std::erase_if(broken_.holes, [](const Loop& hole) { return hole.size() < 3; });
    if (broken_.outer.size() < 3) return;
    frame_ = rings_frame(world, broken_);
    rings_ = rings_of(world, broken_);
    name_corners(broken_.outer, rings_[0]);
    for (std::size_t h = 0; h < broken_.holes.size(); ++h)
      name_corners(broken_.holes[h], rings_[h + 1]);
  }

  // What is wrong and where, in the scan's coordinates; `fault` tells it where nothing here does.
  std::string flaw(const std::string& fault) const {
    if (rings_.empty()) return told("it has no area", middle_of(world_, broken_.outer));
    if (worst_ > kPlanarTolerance)
      return told(fmt::format("a corner is {:.4f} m off its plane", worst_), worst_at_);
    const auto flaw = geos::find_flaw(rings_);
    return flaw && flaw->at ? told(flaw->reason, frame_.to_space(*flaw->at))
                            : told(fault, middle_of(world_, broken_.outer));
  }

  // The largest first.
  std::vector<Surface> mend() {
    std::vector<Surface> sound;
    if (rings_.empty()) return sound;
    for (const geos::Rings& part : geos::make_valid(rings_))
      if (!add(part, sound))
        for (const geos::Rings& wide : geos::subtract(part, {}, kNeck)) add(wide, sound);
    std::stable_sort(sound.begin(), sound.end(), [&](const Surface& a, const Surface& b) {
      return area(world_, a) > area(world_, b);
    });
    const double least = sound.empty() ? 0 : kLeastPart * area(world_, sound[0]);
    std::erase_if(sound, [&](const Surface& s) { return area(world_, s) < least; });
    for (std::size_t k = 1; k < sound.size(); ++k) sound[k].support = {};
    return sound;
  }

 private:
  void name_corners(const Loop& loop, const std::vector<Vec2>& ring) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec3& at = world_.vertices[static_cast<std::size_t>(loop[k])];
      const double off = std::abs(broken_.plane.signed_distance(at));
      if (off <= kPlanarTolerance) vertex_at_[{ring[k].x(), ring[k].y()}] = loop[k];
      if (off > worst_) worst_ = off, worst_at_ = at;
    }
  }

  std::string told(const std::string& what, const Vec3& at) const {
    return fmt::format("{}, at {} of the scan", what, in_scan(world_, at));
  }

  // The corner that was there, or a new one.
  int vertex(const Vec2& p) {
    const auto [found, is_new] =
        vertex_at_.try_emplace({p.x(), p.y()}, static_cast<int>(world_.vertices.size()));
    if (is_new) {
      const Vec3 at = frame_.to_space(p);
      world_.vertices.push_back((at * 1e6).array().round() / 1e6);
    }
    return found->second;
  }

  bool add(const geos::Rings& rings, std::vector<Surface>& sound) {
    Surface surface = broken_;
    surface.holes.clear();
    std::erase_if(surface.inferred, [&](const InferredPart& part) {
      return geos::overlap_of(rings, flat_rings(frame_, part)).area <= 0;
    });
    for (std::size_t r = 0; r < rings.size(); ++r) {
      Loop loop;
      for (const Vec2& p : rings[r]) loop.push_back(vertex(p));
      (r == 0 ? surface.outer : surface.holes.emplace_back()) = std::move(loop);
    }
    if (fault_of(alone(world_, surface))) return false;
    sound.push_back(std::move(surface));
    return true;
  }

  World& world_;
  Surface broken_;
  PlaneFrame frame_;
  geos::Rings rings_;  // none where it has no area at all
  std::map<std::pair<double, double>, int> vertex_at_;
  double worst_ = 0;  // [m] that a corner is off the plane
  Vec3 worst_at_ = Vec3::Zero();
};

Vec3 place_of(const World& world, const Surface& s) { return middle_of(world, s.outer); }
Vec3 place_of(const World& world, const Opening& o) { return middle_of(world, o.loop); }
Vec3 place_of(const World&, const Room& r) { return r.center.value_or(Vec3::Zero()); }
Vec3 place_of(const World&, const CurvedPart& c) { return c.curve.shape.point; }
Vec3 place_of(const World&, const OrientedBox& b) { return b.center; }
Vec3 place_of(const World&, const Cylinder& c) { return c.center; }
Vec3 place_of(const World&, const ConvexHull& h) { return middle_of(h.vertices); }
Vec3 place_of(const World&, const ConvexPrism& p) { return middle_of(p.base); }
template <typename Thing>  // an obstacle or a collider
Vec3 place_of(const World& world, const Thing& thing) {
  return std::visit([&](const auto& shape) { return place_of(world, shape); }, thing.shape);
}
Vec3 place_of(const World& world, const Door& d) {
  for (const Opening& o : world.openings)
    if (o.id == d.opening) return place_of(world, o);
  return Vec3::Zero();
}

Vec3 place_of(const World&, const Way& w) { return (w.foot + w.top) / 2; }

// Keeps the things of one kind that are valid beside what they refer to.
template <typename Thing, typename Beside>
void keep_valid(const World& world, std::vector<Thing> World::*things, const Beside& beside,
                Mended& kept) {
  for (const Thing& thing : world.*things) {
    World trial = beside(thing);
    (trial.*things) = {thing};
    drop_vertices(trial);
    if (const auto fault = fault_of(trial))
      kept.warnings.push_back(fmt::format("{}; it is left out, at {} of the scan", *fault,
                                          in_scan(world, place_of(world, thing))));
    else
      (kept.world.*things).push_back(thing);
  }
}

// A thing stays when the curve that it is part of does not.
template <typename Thing>
void forget_missing_curves(const std::vector<CurvedPart>& curves, std::vector<Thing>& things) {
  for (Thing& thing : things)
    if (std::none_of(curves.begin(), curves.end(),
                     [&](const CurvedPart& c) { return c.id == thing.curve; }))
      thing.curve.reset();
}

}  // namespace

Mended mend_surfaces(World world) {
  std::vector<std::optional<std::string>> faults(world.surfaces.size());
  parallel_for(faults.size(),
               [&](std::size_t i) { faults[i] = fault_of(alone(world, world.surfaces[i])); });
  Mended mended{.world = std::move(world)};
  const std::vector<Surface> found = std::exchange(mended.world.surfaces, {});
  std::vector<Surface> sound;
  for (std::size_t i = 0; i < found.size(); ++i) {
    std::vector<Surface> parts = {found[i]};
    if (faults[i]) {
      Mender mender(mended.world, found[i]);
      const std::string flaw = mender.flaw(unnamed(*faults[i]));
      parts = mender.mend();
      mended.warnings.push_back(
          parts.empty()
              ? fmt::format("a surface of {} points is left out: {}", found[i].support.points, flaw)
              : fmt::format("surface {} was mended into {} polygon{}: {}", sound.size(),
                            parts.size(), parts.size() > 1 ? "s" : "", flaw));
    }
    for (Surface& part : parts) {
      part.id = static_cast<int>(sound.size());
      sound.push_back(std::move(part));
      mended.from.push_back(i);
    }
  }
  mended.world.surfaces = std::move(sound);
  if (mended.warnings.empty()) return mended;
  drop_vertices(mended.world);
  classify(mended.world);
  return mended;
}

Mended leave_out_invalid(World world) {
  std::vector<std::size_t> all(world.surfaces.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (!fault_of(world)) return {std::move(world), {}, std::move(all)};

  World bare{.frame = world.frame, .vertices = world.vertices};
  Mended kept{.world = bare};
  kept.world.provenance = world.provenance;
  const auto beside_nothing = [&](const auto&) { return bare; };
  keep_valid(world, &World::curves, beside_nothing, kept);
  forget_missing_curves(kept.world.curves, world.surfaces);
  forget_missing_curves(kept.world.curves, world.obstacles);
  bare.curves = kept.world.curves;
  const auto beside_its_surface = [&](const auto& thing) {
    World trial = bare;
    if (const Surface* s = find_surface(kept.world, thing.surface)) trial.surfaces = {*s};
    return trial;
  };
  keep_valid(world, &World::surfaces, beside_nothing, kept);
  for (const Surface& s : kept.world.surfaces)
    kept.from.push_back(
        static_cast<std::size_t>(find_surface(world, s.id) - world.surfaces.data()));
  forget_missing_surfaces(surface_ids(kept.world), world);
  const auto beside_surfaces = [&](const Opening& o) {
    World trial = beside_its_surface(o);
    if (o.leaf && o.leaf->surface != o.surface)
      trial.surfaces.push_back(*find_surface(kept.world, o.leaf->surface));
    return trial;
  };
  keep_valid(world, &World::openings, beside_surfaces, kept);
  keep_valid(world, &World::colliders, beside_its_surface, kept);
  keep_valid(world, &World::obstacles, beside_nothing, kept);
  for (Room& room : world.rooms)
    std::erase_if(room.surfaces, [&](int id) {
      if (find_surface(kept.world, id)) return false;
      if (!find_surface(world, id))
        kept.warnings.push_back(
            fmt::format("room {} refers to surface {}, which does not exist; "
                        "the reference is left out, at {} of the scan",
                        room.id, id, in_scan(world, place_of(world, room))));
      return true;
    });
  const auto beside_all = [&](const auto&) {
    World trial = bare;
    trial.surfaces = kept.world.surfaces, trial.openings = kept.world.openings;
    trial.rooms = kept.world.rooms;
    return trial;
  };
  keep_valid(world, &World::rooms, beside_all, kept);
  keep_valid(world, &World::doors, beside_all, kept);
  for (Way& way : world.ways)
    for (std::optional<int>& room : way.rooms)
      if (std::none_of(kept.world.rooms.begin(), kept.world.rooms.end(),
                       [&](const Room& r) { return r.id == room; }))
        room.reset();
  keep_valid(world, &World::ways, beside_all, kept);
  drop_vertices(kept.world);
  return kept;
}

}  // namespace scanworld
