// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "seen_space.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "../cell_sight.h"
#include "../cell_walk.h"
#include "../mix.h"
#include "../parallel.h"
#include "surface_rings.h"

namespace scanworld {

namespace {

constexpr std::size_t kSeenLinesPerPart = 4096;

CellSet find_occupied(const PointCloud& cloud, double cell) {
  CellSet occupied;
  for (const Vec3f& point : cloud.points)
    if (const Vec3 p = point.cast<double>(); has_code(p, cell))
      occupied.insert(morton_of(cell_of(p, cell)));
  return occupied;
}

// A way through cells, in units of them.
struct ClippedWay {
  Vec3 from;
  Eigen::Vector3i to;
};

// The part of a way that is in a box, if any.
std::optional<ClippedWay> clip_way(const Vec3& from, const Vec3& to, const Box3& box) {
  double begin = 0, end = 1;
  for (int k = 0; k < 3; ++k) {
    const double step = to[k] - from[k];
    double enter = (box.min()[k] - from[k]) / step, leave = (box.max()[k] - from[k]) / step;
    if (step == 0) {
      if (from[k] < box.min()[k] || from[k] > box.max()[k]) return std::nullopt;
      continue;
    }
    if (step < 0) std::swap(enter, leave);
    begin = std::max(begin, enter), end = std::min(end, leave);
  }
  if (begin >= end) return std::nullopt;
  const Vec3 last = from + end * (to - from);
  return ClippedWay{from + begin * (to - from), last.array().floor().cast<int>()};
}

// The union of what follow(i, cells) sees.
template <typename Follow>
CellSet follow_all(std::size_t count, const Follow& follow) {
  std::vector<CellSet> found(part_count(count, kSeenLinesPerPart));
  parallel_for(found.size(), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, count, kSeenLinesPerPart);
    for (std::size_t i = begin; i < end; ++i) follow(i, found[part]);
  });
  CellSet all;
  for (const CellSet& cells : found) all.insert(cells);
  return all;
}

// From the viewpoints to the cells with points; where those are too many, to some of them.
CellSet look_from_viewpoints(const PointCloud& cloud, const CellSet& occupied, const Box3& where,
                             double cell, const SeenSpaceOptions& options) {
  std::vector<Vec3> viewpoints;
  std::vector<std::int32_t> number;  // among those, or -1
  for (const Vec3& v : cloud.viewpoints) {
    const bool is_near = has_code(v, cell);
    number.push_back(is_near ? static_cast<std::int32_t>(viewpoints.size()) : -1);
    if (is_near) viewpoints.push_back(v);
  }
  std::vector<std::uint64_t> targets = occupied.codes();
  const std::uint64_t stride = targets.size() / static_cast<std::size_t>(options.max_lines) + 1;
  std::erase_if(targets, [&](std::uint64_t code) { return mix(code) % stride != 0; });
  std::vector<OwnViewer> own = own_viewers(cloud, targets, cell);
  for (OwnViewer& o : own)
    if (o.viewer >= 0) o.viewer = number[static_cast<std::size_t>(o.viewer)];
  const auto viewers = find_viewers(targets, viewpoints, cell, occupied, own);
  return follow_all(targets.size(), [&](std::size_t i, CellSet& seen) {
    if (viewers[i] == kNobody) return;
    const auto way = clip_way(viewpoints[viewers[i]] / cell,
                              cell_at(targets[i]).cast<double>() + Vec3::Constant(0.5), where);
    if (!way) return;
    CellSet::Reader cells(occupied);
    walk_cells(way->from, way->to, [&](std::uint64_t code) {
      if (!cells.contains(code)) seen.insert(code);
      return true;
    });
  });
}

// A place on a surface, where there are points.
struct SurfacePlace {
  Vec3 at, normal;
};

std::vector<SurfacePlace> places_on_surfaces(const World& world, const CellSet& occupied,
                                             double cell, const SeenSpaceOptions& options) {
  double total = 0;
  for (const Surface& s : world.surfaces) total += area(world, s);
  const double step = std::max(cell, std::sqrt(total / options.max_places));
  std::vector<SurfacePlace> places;
  for (const Surface& s : world.surfaces) {
    const PlaneFrame frame = rings_frame(world, s);
    const geos::Rings rings = rings_of(world, s);
    Eigen::AlignedBox2d box;
    for (const Vec2& p : rings[0]) box.extend(p);
    for (double y = box.min().y() + step / 2; y < box.max().y(); y += step)
      for (double x = box.min().x() + step / 2; x < box.max().x(); x += step) {
        if (!is_inside(rings, {x, y})) continue;
        const Vec3 at = frame.to_space({x, y});
        if (occupied.contains(at, cell)) places.push_back({at, s.plane.normal});
      }
  }
  return places;
}

// Between places that face each other. Each looks at as many others, drawn evenly.
CellSet look_between_surfaces(const World& world, const CellSet& occupied, const Box3& where,
                              double cell, const SeenSpaceOptions& options) {
  const std::vector<SurfacePlace> places = places_on_surfaces(world, occupied, cell, options);
  if (places.empty()) return {};
  const std::size_t others = static_cast<std::size_t>(options.max_lines) / places.size() + 1;
  const double off = 1.5 * cell;  // off a surface, its own points are not in the way
  return follow_all(places.size() * others, [&](std::size_t i, CellSet& seen) {
    const SurfacePlace& a = places[i / others];
    const SurfacePlace& b = places[mix(i) % places.size()];
    const Vec3 way = b.at - a.at;
    const double least = options.min_cosine * way.norm();
    if (a.normal.dot(way) <= least || -b.normal.dot(way) <= least) return;
    const Vec3 from = (a.at + off * a.normal) / cell;
    const Vec3 end = b.at + off * b.normal;
    const Eigen::Vector3i to = cell_of(end, cell);
    const auto way_inside = clip_way(from, end / cell, where);
    if (!way_inside) return;
    CellSet::Reader cells(occupied);
    bool is_free = !cells.contains(morton_of(to));
    if (is_free)
      walk_cells(from, to, [&](std::uint64_t code) { return is_free = !cells.contains(code); });
    if (!is_free) return;
    walk_cells(way_inside->from, way_inside->to, [&](std::uint64_t code) {
      seen.insert(code);
      return true;
    });
  });
}

}  // namespace

bool SeenSpace::contains(const Eigen::Vector3i& at) const {
  return at.cwiseAbs().maxCoeff() < kFarthestCell && through.contains(morton_of(at));
}

std::vector<Vec3> SeenSpace::in(const Box3& box) const {
  std::vector<Vec3> middles;
  if (box.isEmpty()) return middles;
  const Eigen::Vector3i low = cell_of(box.min(), cell), high = cell_of(box.max(), cell);
  for (int z = low.z(); z <= high.z(); ++z)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int x = low.x(); x <= high.x(); ++x)
        if (contains({x, y, z})) middles.push_back(Vec3(x + 0.5, y + 0.5, z + 0.5) * cell);
  return middles;
}

SeenSpace find_seen_space(const PointCloud& cloud, const World& world, const Box3& where,
                          double cell, const SeenSpaceOptions& options) {
  const CellSet occupied = find_occupied(cloud, cell);
  const Box3 cells(where.min() / cell, where.max() / cell);
  if (cloud.viewpoints.empty())
    return {cell, look_between_surfaces(world, occupied, cells, cell, options), false};
  return {cell, look_from_viewpoints(cloud, occupied, cells, cell, options), true};
}

}  // namespace scanworld
