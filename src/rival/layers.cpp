// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "layers.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "../cell_set.h"
#include "../cell_walk.h"
#include "../polygon.h"
#include "../quantile.h"
#include "join.h"

namespace scanworld::rival {

namespace {

constexpr double kFar = 10;          // [m] what is seen across a room is no farther
constexpr double kMinCell = 0.04;    // [m] in which that is looked for
constexpr double kMost = 0.33;       // share of the sites that have room before them, of a side
constexpr double kNoise = 3;         // [noise] a layer's points are no farther from it
constexpr std::size_t kLooks = 100;  // sites of a cluster from which is looked, about

// What the heights over a plane add up to, in a square of it.
struct Heights {
  std::pair<int, int> square;
  double sum = 0, points = 0;
  double mean() const { return sum / points; }
};
using HeightMap = std::vector<Heights>;  // in the order of their squares

HeightMap map_heights(const Grid& grid, const std::vector<std::uint32_t>& sites,
                      const MomentFit& over, double edge) {
  const PlaneFrame frame = frame_of(over.plane, over.centroid);
  HeightMap all, heights;
  all.reserve(sites.size());
  for (const std::uint32_t i : sites) {
    const Site& s = grid.sites[i];
    all.push_back({square_of(frame.to_plane(s.position()), edge),
                   s.points * over.plane.signed_distance(s.position()),
                   static_cast<double>(s.points)});
  }
  std::ranges::stable_sort(all, {}, &Heights::square);
  for (const Heights& h : all)
    if (!heights.empty() && heights.back().square == h.square)
      heights.back().sum += h.sum, heights.back().points += h.points;
    else
      heights.push_back(h);
  return heights;
}

// Two clusters that are in the same squares.
struct Overlap {
  std::size_t larger, smaller;
  double offset;  // [m] of the smaller one over the plane of the larger, the median
  double share;   // of the smaller one's squares
  double area;    // [m2] of those
};

Overlap compare(const HeightMap& there, const HeightMap& here, double edge) {
  std::vector<double> offsets;
  auto found = there.begin();
  for (const Heights& h : here) {
    while (found != there.end() && found->square < h.square) ++found;
    if (found != there.end() && found->square == h.square)
      offsets.push_back(h.mean() - found->mean());
  }
  if (offsets.empty()) return {};
  const auto count = static_cast<double>(offsets.size());
  return {0, 0, median(std::move(offsets)), count / static_cast<double>(here.size()),
          count * edge * edge};
}

std::vector<Overlap> find_overlaps(const Grid& grid, const Clustering& c,
                                   const std::vector<std::vector<std::uint32_t>>& members,
                                   const LayerOptions& options) {
  std::vector<Box3> boxes(members.size());
  for (std::size_t k = 0; k < members.size(); ++k)
    for (const std::uint32_t i : members[k]) boxes[k].extend(grid.sites[i].position());
  const auto rank = [&](std::size_t k) { return std::pair(members[k].size(), k); };
  const double edge = options.cell * grid.voxel, parallel = std::cos(options.max_angle);
  std::vector<Overlap> overlaps;
  for (std::size_t a = 0; a < members.size(); ++a) {
    if (members[a].empty()) continue;
    const MomentFit& over = c.clusters[a].fit;
    const Box3 reach = grown(boxes[a], options.max_offset);
    HeightMap there;
    for (std::size_t b = 0; b < members.size(); ++b) {
      if (members[b].empty() || rank(b) >= rank(a) || !reach.intersects(boxes[b]) ||
          std::abs(over.plane.normal.dot(c.clusters[b].fit.plane.normal)) < parallel)
        continue;
      if (there.empty()) there = map_heights(grid, members[a], over, edge);
      Overlap overlap = compare(there, map_heights(grid, members[b], over, edge), edge);
      const double offset = std::abs(overlap.offset);
      if (overlap.share < options.min_overlap || offset > options.max_offset ||
          offset < options.min_offset * grid.voxel)
        continue;
      overlap.larger = a, overlap.smaller = b;
      overlaps.push_back(overlap);
    }
  }
  return overlaps;
}

// The cells of a scan that hold points.
struct Cells {
  double edge;  // [m]
  CellSet occupied;

  bool has(const Vec3& p) const { return occupied.contains(p, edge); }
};

Cells find_cells(const Grid& grid) {
  Cells cells{std::max(grid.voxel, kMinCell), {}};
  for (const Site& s : grid.sites)
    if (const Vec3 p = s.position(); has_code(p, cells.edge))
      cells.occupied.insert(morton_of(cell_of(p, cells.edge)));
  return cells;
}

// Whether something is across from there, but nothing near beyond what is skipped [m].
bool has_room(const Cells& cells, const Vec3& from, const Vec3& way, double skipped, double room) {
  for (double t = skipped + cells.edge; t < kFar; t += cells.edge)
    if (cells.has(from + t * way)) return t > room;
  return false;
}

// Whether two clusters are the two sides of something.
bool are_sides(const Overlap& overlap, const Grid& grid, const Scale& scale, const Clustering& c,
               const std::vector<std::vector<std::uint32_t>>& members, const Cells& cells,
               double room) {
  const double skipped = std::abs(overlap.offset) + kNoise * scale.noise;
  const auto is_side = [&](std::size_t k, const Vec3& way) {
    const std::vector<std::uint32_t>& sites = members[k];
    const std::size_t step = sites.size() / kLooks + 1;
    double with = 0, all = 0;
    for (std::size_t i = 0; i < sites.size(); i += step, ++all)
      with += has_room(cells, grid.sites[sites[i]].position(), way, skipped, room);
    return with > kMost * all;
  };
  const Vec3 out = (overlap.offset < 0 ? -1 : 1) * c.clusters[overlap.larger].fit.plane.normal;
  return is_side(overlap.smaller, out) && is_side(overlap.larger, -out);
}

}  // namespace

Layers find_layers(const Grid& grid, const Scale& scale, const Clustering& c,
                   const LayerOptions& options) {
  const std::vector<std::vector<std::uint32_t>> members = members_of(c);
  const std::vector<Overlap> overlaps = find_overlaps(grid, c, members, options);
  Layers layers;
  if (overlaps.empty()) return layers;
  const Cells cells = find_cells(grid);
  std::vector<std::pair<double, double>> offsets;
  double in_pairs = 0, all = 0;
  for (const Overlap& o : overlaps) {
    if (are_sides(o, grid, scale, c, members, cells, options.room)) continue;
    layers.pairs.emplace_back(o.larger, o.smaller);
    offsets.emplace_back(std::abs(o.offset), o.area);
    in_pairs += o.area;
  }
  for (const Cluster& cluster : c.clusters) all += area_of(cluster.fit);
  layers.offset = weighted_median(std::move(offsets));
  layers.share = all > 0 ? in_pairs / all : 0;
  return layers;
}

Flatness allow_drift(Flatness flatness, const Layers& layers, const LayerOptions& options) {
  if (layers.share < options.min_share) return flatness;
  flatness.drift = layers.offset;
  flatness.max_bend = std::max(flatness.max_bend, options.bend * layers.offset);
  flatness.max_sag = std::max(flatness.max_sag, options.bend * layers.offset);
  return flatness;
}

Clustering join_layers(const Grid& grid, const Scale& scale, Clustering c,
                       const LayerOptions& options) {
  if (scale.flatness.drift == 0) return c;
  const Layers layers = find_layers(grid, scale, c, options);
  Joiner joiner(std::move(c));
  for (const auto& [larger, smaller] : layers.pairs) {
    const Cluster &a = joiner.whole(larger), &b = joiner.whole(smaller);
    if (&a == &b) continue;
    // Layer upon layer would else become as thick as one likes.
    const double rms = std::sqrt(fit(a.moments + b.moments).variance[0]);
    if (rms <= options.max_offset / 2 + scale.noise) joiner.join(larger, smaller);
  }
  return joiner.finish(grid);
}

}  // namespace scanworld::rival
