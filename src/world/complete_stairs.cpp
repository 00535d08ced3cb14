// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "complete_stairs.h"

#include <algorithm>
#include <cmath>

#include "../quantile.h"
#include "surface_rings.h"
#include "vertex_pool.h"

namespace scanworld {

namespace {

using Box2 = Eigen::AlignedBox2d;

constexpr double kBeyond = 0.05;    // [m] a line of sight goes on behind what it goes through
constexpr double kOverlap = 0.006;  // [m] over what is beside it, as edges nearly meet there:
                                    // treads stand out over risers, and these end below them

// A tread or a riser as it should be: from a corner along two sides, seen from where its normal is.
struct Panel {
  Kind kind = Kind::floor;
  PlaneFrame frame;  // its origin is the corner
  Vec2 size;         // [m]
};

// A flight's middle line, from its foot.
struct FlightAxes {
  Vec3 along, across, up;
};

FlightAxes axes_of(const Way& way, const Vec3& up) {
  const Vec3 rise = way.top - way.foot;
  const Vec3 along = (rise - up.dot(rise) * up).normalized();
  return {along, up.cross(along), up};
}

class Completer {
 public:
  Completer(World world, std::span<const SightLine> lines, const StairsOptions& options)
      : world_(std::move(world)),
        lines_(lines),
        options_(options),
        pool_(world_.vertices),
        next_id_(next_id(world_)) {}

  void complete(const Way& way) {
    const FlightAxes axes = axes_of(way, world_.frame.up);
    std::vector<char> is_missing(static_cast<std::size_t>(way.steps) + 1);
    for (int k = 1; k < way.steps; ++k)
      is_missing[static_cast<std::size_t>(k)] = add_missing(tread(way, axes, k), way.riser / 2);
    for (int k = 1; k <= way.steps; ++k)
      if (is_missing[static_cast<std::size_t>(k)] || is_missing[static_cast<std::size_t>(k) - 1])
        add_missing(riser(way, axes, k), way.riser / 2);
  }

  World take() { return std::move(world_); }

 private:
  // The k-th tread, from 1.
  static Panel tread(const Way& way, const FlightAxes& axes, int k) {
    const Vec3 corner = way.foot + axes.up * (k * way.riser) + axes.along * ((k - 1) * way.tread) -
                        axes.across * (way.width / 2);
    return {Kind::floor, {corner, axes.along, axes.across}, {way.tread, way.width}};
  }

  // The one below its front edge.
  static Panel riser(const Way& way, const FlightAxes& axes, int k) {
    const Vec3 corner = way.foot + axes.up * ((k - 1) * way.riser) +
                        axes.along * ((k - 1) * way.tread) - axes.across * (way.width / 2);
    return {Kind::other, {corner, axes.up, axes.across}, {way.riser, way.width}};
  }

  // A surface that may be a part of a panel, in that one's frame.
  struct Near {
    geos::Rings rings;
    double off = 0;  // [m] of the panel's middle from its plane
  };

  std::vector<Near> surfaces_at(const Panel& panel) const {
    const Vec3 normal = panel.frame.u.cross(panel.frame.v);
    const Vec3 middle = panel.frame.to_space(panel.size / 2);
    const Box2 box(Vec2::Zero(), panel.size);
    std::vector<Near> near;
    for (const Surface& s : world_.surfaces) {
      const double off = s.plane.signed_distance(middle);
      if (s.plane.normal.dot(normal) < options_.same_cosine || std::abs(off) > options_.same)
        continue;
      geos::Rings rings = rings_of(world_, s, panel.frame);
      Box2 own;
      for (const Vec2& p : rings[0]) own.extend(p);
      if (own.intersects(box)) near.push_back({std::move(rings), off});
    }
    return near;
  }

  // Adds what is missing of a panel as one rectangle; false where nothing is to be added.
  bool add_missing(Panel panel, double thickness) {
    const std::vector<Near> near = surfaces_at(panel);
    const auto count = [&](int axis) {
      return std::max(1, static_cast<int>(std::round(panel.size[axis] / options_.cell)));
    };
    const int columns = count(0), rows = count(1);
    const Vec2 cell = panel.size.cwiseQuotient(Vec2(columns, rows));
    Box2 missing;
    std::vector<double> offs;
    int open = 0;
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) {
        const Vec2 p = cell.cwiseProduct(Vec2(x + 0.5, y + 0.5));
        const auto there = std::find_if(near.begin(), near.end(),
                                        [&](const Near& n) { return is_inside(n.rings, p); });
        if (there != near.end()) {
          offs.push_back(there->off);
          continue;
        }
        ++open;
        missing.extend(p - cell / 2), missing.extend(p + cell / 2);
      }
    if (open < options_.min_missing * columns * rows) return false;
    const Vec3 normal = panel.frame.u.cross(panel.frame.v);
    if (!offs.empty()) panel.frame.origin -= median(offs) * normal;
    if (lines_through(panel, missing) > options_.max_lines * missing.volume()) return false;
    Box2 part(missing.min().array() - kOverlap, missing.max().array() + kOverlap);
    if (panel.kind != Kind::floor) part.max().x() -= 2 * kOverlap;
    add(panel, part, thickness);
    return true;
  }

  double lines_through(const Panel& panel, const Box2& part) const {
    const Plane plane = plane_through(panel.frame.origin, panel.frame.u.cross(panel.frame.v));
    std::size_t lines = 0;
    for (const SightLine& line : lines_) {
      if (std::abs(plane.signed_distance(line.from)) < kBeyond) continue;
      if (const auto place = line.crossing(plane, kBeyond))
        lines += part.contains(panel.frame.to_plane(*place));
    }
    return static_cast<double>(lines);
  }

  void add(const Panel& panel, const Box2& part, double thickness) {
    std::vector<Vec2> ring;
    for (const auto corner : {Box2::BottomLeft, Box2::BottomRight, Box2::TopRight, Box2::TopLeft})
      ring.push_back(part.corner(corner));
    Surface surface{.id = next_id_++,
                    .kind = panel.kind,
                    .source = Source::inferred,
                    .plane = plane_through(panel.frame.origin, panel.frame.u.cross(panel.frame.v)),
                    .outer = pool_.add(placed_ring(panel.frame, ring)),
                    .thickness = thickness};
    world_.surfaces.push_back(std::move(surface));
  }

  World world_;
  const std::span<const SightLine> lines_;
  const StairsOptions& options_;
  VertexPool pool_;
  int next_id_;
};

}  // namespace

World complete_stairs(World world, std::span<const SightLine> lines, const StairsOptions& options,
                      const WayOptions& ways) {
  const std::vector<Way> found = find_ways(world, Upright(world), ways);
  Completer completer(std::move(world), lines, options);
  for (const Way& way : found)
    if (way.kind == WayKind::stairs) completer.complete(way);
  return completer.take();
}

OptionList list_options(StairsOptions& o) {
  return {
      {"stairs.on", &o.is_on, "", "whether treads that nothing was seen of are added"},
      {"stairs.cell", &o.cell, "m", "in which it is asked what of a tread is there", 0.005},
      {"stairs.same", &o.same, "m", "a surface is no farther off the tread that it is", 0},
      {"stairs.same_cosine", &o.same_cosine, "", "and looks the same way", 0, 1},
      {"stairs.min_missing", &o.min_missing, "",
       "share of a tread or a riser; with less missing it is as it is", 0, 1},
      {"stairs.max_lines", &o.max_lines, "1/m2",
       "of sight through what is missing; more tell that it is open", 0},
  };
}

}  // namespace scanworld
