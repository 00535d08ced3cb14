// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "record.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <tuple>

#include "mix.h"
#include "surface/patch.h"
#include "surface/raster_outlines.h"
#include "thesis/hull.h"

namespace scanworld {

namespace {

// The outlines of the cells with points, gaps of one or two of them closed; of larger cells where
// there would be too many.
std::vector<surface::Ring> outlines_of(const std::vector<Vec2>& points, double cell) {
  constexpr double kMost = 1e6;
  Eigen::AlignedBox2d box;
  for (const Vec2& p : points) box.extend(p);
  const Vec2 size = box.sizes();
  cell = std::max({cell, std::sqrt(size.x() * size.y() / kMost), size.maxCoeff() / kMost});
  surface::Raster raster = surface::raster_around(box, 2 * cell, cell);
  for (const Vec2& p : points) surface::set(raster, p);
  return surface::outline_rings(surface::close(raster, 1));
}

}  // namespace

void Recorder::start(std::string method, std::vector<Vec3> points, double cell, std::size_t shown) {
  if (!is_on_) return;
  cell_ = cell;
  points_ = std::move(points);
  now_.assign(points_.size(), -1);
  shown_.resize(points_.size());
  std::iota(shown_.begin(), shown_.end(), 0u);
  if (shown_.size() > shown) {
    const auto by_hash = [](std::uint32_t a, std::uint32_t b) { return mix(a) < mix(b); };
    std::nth_element(shown_.begin(), shown_.begin() + static_cast<std::ptrdiff_t>(shown),
                     shown_.end(), by_hash);
    shown_.resize(shown);
    std::sort(shown_.begin(), shown_.end());
  }
  replay_.method = std::move(method);
  for (std::uint32_t i : shown_) replay_.points.push_back(points_[i]);
}

// The numbers of clusters: of the pairs of a label and a number of the step before, those with most
// points in common first, each label and each number once.
std::vector<int> Recorder::find_ids(const std::vector<std::int32_t>& label, std::size_t clusters) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> common;
  auto last = common.end();  // most points are like the one before
  for (std::size_t i = 0; i < label.size(); ++i) {
    if (label[i] < 0 || now_[i] < 0) continue;
    const std::pair key(label[i], now_[i]);
    if (last == common.end() || last->first != key) last = common.try_emplace(key, 0).first;
    ++last->second;
  }
  std::vector<std::tuple<std::size_t, std::int32_t, std::int32_t>> pairs;
  for (const auto& [pair, count] : common) pairs.emplace_back(count, pair.first, pair.second);
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto& a, const auto& b) { return std::get<0>(a) > std::get<0>(b); });
  std::vector<int> ids(clusters, -1);
  std::vector<char> taken(static_cast<std::size_t>(next_id_));
  for (const auto& [count, l, id] : pairs) {
    int& own = ids[static_cast<std::size_t>(l)];
    char& is_taken = taken[static_cast<std::size_t>(id)];
    if (own < 0 && !is_taken) own = id, is_taken = 1;
  }
  for (int& id : ids)
    if (id < 0) id = next_id_++;
  return ids;
}

std::vector<ReplayLoop> Recorder::drawn(const std::vector<std::int32_t>& label,
                                        const std::vector<Plane>& planes) const {
  const surface::Members members = surface::group_points(label, planes.size());
  std::vector<ReplayLoop> loops;
  for (std::size_t l = 0; l < planes.size(); ++l) {
    if (members.of(l).size() < 3) continue;
    if (cell_ > 0) {
      const PlaneFrame frame = frame_of(planes[l]);
      std::vector<Vec2> flat;
      for (std::uint32_t i : members.of(l)) flat.push_back(frame.to_plane(points_[i]));
      for (const surface::Ring& ring : outlines_of(flat, cell_)) {
        loops.push_back({ids_[l], ring.is_hole, {}});
        for (const Vec2& p : ring.points) loops.back().vertices.push_back(frame.to_space(p));
      }
    } else {
      std::vector<Vec3> flat;
      for (std::uint32_t i : members.of(l)) flat.push_back(planes[l].project(points_[i]));
      std::vector<Vec3> border = thesis::convex_hull(flat, planes[l].normal);
      if (border.size() >= 3) loops.push_back({ids_[l], false, std::move(border)});
    }
  }
  return loops;
}

void Recorder::add(std::string stage, std::string text, const std::vector<std::int32_t>& label,
                   const std::vector<Plane>& planes) {
  if (!is_on_) return;
  ids_ = find_ids(label, planes.size());
  ReplayStep step{.stage = std::move(stage), .text = std::move(text)};
  std::vector<char> lives(planes.size());
  std::vector<std::int32_t> next(label.size(), -1);
  for (std::size_t i = 0; i < label.size(); ++i) {
    if (label[i] < 0) continue;
    next[i] = ids_[static_cast<std::size_t>(label[i])];
    lives[static_cast<std::size_t>(label[i])] = 1;
  }
  step.clusters = static_cast<std::size_t>(std::count(lives.begin(), lives.end(), 1));
  for (std::size_t i = 0; i < next.size(); ++i) step.changed += next[i] != now_[i];
  for (std::size_t k = 0; k < shown_.size(); ++k)
    if (const std::uint32_t i = shown_[k]; next[i] != now_[i]) {
      step.points.push_back(static_cast<std::uint32_t>(k));
      step.cluster.push_back(next[i]);
    }
  step.loops = drawn(label, planes);
  now_ = std::move(next);
  replay_.steps.push_back(std::move(step));
}

void Recorder::mark(std::string stage, std::string text, const std::vector<std::int32_t>& label) {
  if (!is_on_) return;
  add(std::move(stage), std::move(text), label, {Plane{}});
  replay_.steps.back().clusters = 0;
  replay_.steps.back().loops.clear();
}

void Recorder::add(std::string stage, std::string text, std::vector<ReplayLoop> loops) {
  if (!is_on_) return;
  for (ReplayLoop& loop : loops) {
    const auto label = static_cast<std::size_t>(loop.cluster);
    while (ids_.size() <= label) ids_.push_back(next_id_++);
    loop.cluster = ids_[label];
  }
  const std::size_t clusters = replay_.steps.empty() ? 0 : replay_.steps.back().clusters;
  replay_.steps.push_back({.stage = std::move(stage),
                           .text = std::move(text),
                           .clusters = clusters,
                           .loops = std::move(loops)});
}

std::optional<Replay> Recorder::finish(const Frame& frame, const Vec3& origin) && {
  if (!is_on_) return std::nullopt;
  for (Vec3& p : replay_.points) p = frame.to_world(p + origin);
  for (ReplayStep& step : replay_.steps)
    for (ReplayLoop& loop : step.loops)
      for (Vec3& v : loop.vertices) v = frame.to_world(v + origin);
  return std::move(replay_);
}

namespace {

void add_clusters(Recorder& recorder, const char* stage, const char* text, std::size_t points,
                  std::span<const thesis::Cluster> clusters) {
  std::vector<std::int32_t> label(points, -1);
  std::vector<Plane> planes;
  for (const thesis::Cluster& cluster : clusters) {
    for (int p : cluster.members)
      label[static_cast<std::size_t>(p)] = static_cast<std::int32_t>(planes.size());
    planes.push_back(cluster.fit.plane);
  }
  recorder.add(stage, text, label, planes);
}

}  // namespace

void record_seeds(Recorder& recorder, const rival::Grid& grid,
                  const std::vector<rival::LocalPlane>& local) {
  if (!recorder.is_on()) return;
  std::vector<Vec3> points;
  for (const rival::Site& site : grid.sites) points.push_back(site.position());
  recorder.start("rival", std::move(points), 2 * grid.voxel);
  std::vector<std::int32_t> label;
  for (const rival::LocalPlane& plane : local) label.push_back(plane.planar() ? 0 : -1);
  recorder.mark("Seeds", "clusters may grow from where it is flat", label);
}

rival::Observer watch(Recorder& recorder, std::string stage) {
  if (!recorder.is_on()) return {};
  return [&recorder, stage = std::move(stage)](std::string_view what,
                                               const rival::Clustering& clusters) {
    std::vector<Plane> planes;
    for (const rival::Cluster& cluster : clusters.clusters) planes.push_back(cluster.fit.plane);
    recorder.add(stage, std::string(what), clusters.label, planes);
  };
}

void record_placing(Recorder& recorder, const std::vector<Vec3>& points,
                    const std::vector<thesis::Cluster>& placed) {
  constexpr std::size_t kSteps = 10;
  if (!recorder.is_on()) return;
  recorder.start("thesis", points);
  for (std::size_t k = 1; k <= kSteps; ++k)
    add_clusters(recorder, "Placing", "small clusters are placed where points are flat",
                 points.size(), std::span(placed).first(placed.size() * k / kSteps));
}

thesis::SpreadingObserver watch_spreading(Recorder& recorder, std::size_t points) {
  if (!recorder.is_on()) return {};
  return [&recorder, points](const std::vector<thesis::Cluster>& clusters) {
    add_clusters(recorder, "Spreading", "clusters take what is in their planes", points, clusters);
  };
}

void record_walls(Recorder& recorder, std::size_t points,
                  const std::vector<thesis::Cluster>& walls) {
  if (recorder.is_on())
    add_clusters(recorder, "Final approximation", "clusters that are walls", points, walls);
}

namespace {

// Of each plane of the complex the patch with most points in it; of others a number after all
// patches.
std::vector<int> patches_in_planes(const space::LabelledSpace& space) {
  const auto& parts = space.arrangement.parts;
  int next = 0;
  for (const space::SpacePlane& p : space.planes) next = std::max(next, p.patch + 1);
  std::vector<int> patch_of(parts.size());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    double most = 0;
    patch_of[k] = next + static_cast<int>(k);
    for (const auto& part : parts[k]) {
      const space::SpacePlane& p = space.planes[static_cast<std::size_t>(part.plane)];
      if (p.kind == space::SpacePlane::Kind::surface && p.size > most)
        most = p.size, patch_of[k] = p.patch;
    }
  }
  return patch_of;
}

ReplayLoop loop_of(const space::LabelledSpace& space, const space::CellFacet& facet, int label) {
  ReplayLoop loop{label, false, {}};
  for (const int v : facet.vertices) loop.vertices.push_back(space.arrangement.cells.vertex(v));
  return loop;
}

}  // namespace

std::vector<ReplayLoop> cells_of(const space::LabelledSpace& space, std::size_t most) {
  const std::vector<space::CellFacet>& facets = space.arrangement.cells.facets();
  const std::vector<int> patch_of = patches_in_planes(space);
  std::vector<std::size_t> shown;
  for (std::size_t f = 0; f < facets.size(); ++f)
    if (facets[f].cells[0] >= 0 && facets[f].cells[1] >= 0 && !space.evidence.facets[f].is_bare)
      shown.push_back(f);
  std::stable_sort(shown.begin(), shown.end(), [&](std::size_t a, std::size_t b) {
    return space.evidence.facets[a].area > space.evidence.facets[b].area;
  });
  if (shown.size() > most) shown.resize(most);
  std::vector<ReplayLoop> loops;
  for (const std::size_t f : shown)
    loops.push_back(loop_of(space, facets[f], patch_of[static_cast<std::size_t>(facets[f].plane)]));
  return loops;
}

std::vector<ReplayLoop> free_sides_of(const space::LabelledSpace& space) {
  const std::vector<int> patch_of = patches_in_planes(space);
  std::vector<ReplayLoop> loops;
  for (const space::CellFacet& facet : space.arrangement.cells.facets()) {
    if (facet.cells[0] < 0 || facet.cells[1] < 0) continue;
    const auto label = [&](std::size_t side) {
      return space.labels[static_cast<std::size_t>(facet.cells[side])];
    };
    if (label(0) != label(1) && label(0) != space::Label::unknown &&
        label(1) != space::Label::unknown)
      loops.push_back(loop_of(space, facet, patch_of[static_cast<std::size_t>(facet.plane)]));
  }
  return loops;
}

std::vector<ReplayLoop> loops_of(const std::vector<surface::CornerPolygon>& polygons) {
  std::vector<ReplayLoop> loops;
  for (const surface::CornerPolygon& polygon : polygons)
    for (std::size_t k = 0; k < polygon.loops.size(); ++k) {
      ReplayLoop loop{polygon.patch, k > 0, {}};
      for (const surface::Corner& corner : polygon.loops[k]) loop.vertices.push_back(corner.at);
      loops.push_back(std::move(loop));
    }
  return loops;
}

std::vector<ReplayLoop> loops_of(const std::vector<surface::Piece>& pieces) {
  std::vector<ReplayLoop> loops;
  for (const surface::Piece& piece : pieces)
    for (std::size_t k = 0; k < piece.loops.size(); ++k)
      loops.push_back({piece.patch, k > 0, piece.loops[k]});
  return loops;
}

std::vector<ReplayLoop> loops_of(const std::vector<thesis::Polygon>& polygons) {
  std::vector<ReplayLoop> loops;
  for (std::size_t k = 0; k < polygons.size(); ++k)
    if (polygons[k].size() >= 3) loops.push_back({static_cast<int>(k), false, polygons[k]});
  return loops;
}

std::vector<ReplayLoop> loops_of(const std::vector<thesis::Polygon>& polygons,
                                 const std::vector<std::vector<std::array<int, 3>>>& triangles) {
  std::vector<ReplayLoop> loops;
  for (std::size_t k = 0; k < triangles.size(); ++k)
    for (const auto& t : triangles[k]) {
      ReplayLoop loop{static_cast<int>(k), false, {}};
      for (int corner : t) loop.vertices.push_back(polygons[k][static_cast<std::size_t>(corner)]);
      loops.push_back(std::move(loop));
    }
  return loops;
}

}  // namespace scanworld
