// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "weld.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "../disjoint_sets.h"
#include "../parallel.h"
#include "../polygon.h"
#include "cut_line.h"
#include "trace_loops.h"

namespace scanworld::surface {

namespace {

std::vector<Vec2> flatten(const std::vector<Vec3>& loop, const PlaneFrame& frame) {
  std::vector<Vec2> flat;
  for (const Vec3& v : loop) flat.push_back(frame.to_plane(v));
  return flat;
}

// Whether the middle of the hole's first edge is in the loop, or on it.
bool is_around(const std::vector<Vec3>& loop, const std::vector<Vec3>& hole,
               const PlaneFrame& frame) {
  return is_inside({flatten(loop, frame)}, frame.to_plane((hole[0] + hole[1]) / 2));
}

class Welder {
 public:
  Welder(const std::vector<CornerPolygon>& polygons, const std::vector<Plane>& planes,
         const WeldOptions& options)
      : polygons_(polygons), planes_(planes), options_(options) {
    for (const CornerPolygon& polygon : polygons)
      for (const auto& loop : polygon.loops)
        for (const Corner& corner : loop) add(corner);
    join();
    for (const auto& [key, v] : index_)
      for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}})
        on_line_[{key[static_cast<std::size_t>(a)], key[static_cast<std::size_t>(b)]}].push_back(
            name_[static_cast<std::size_t>(v)]);
    for (auto& [line, list] : on_line_) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  }

  // The edges of a polygon from vertex to vertex.
  std::vector<HalfEdge> edges_of(const CornerPolygon& polygon) const {
    std::vector<HalfEdge> edges;
    for (const auto& loop : polygon.loops)
      for (std::size_t k = 0; k < loop.size(); ++k) {
        int from = vertex_of(loop[k]);
        const int to = vertex_of(loop[(k + 1) % loop.size()]);
        if (from == to) continue;
        for (int v : between(polygon.patch, loop[k].next, from, to)) {
          edges.push_back({from, v});
          from = v;
        }
        edges.push_back({from, to});
      }
    return edges;
  }

  const Vec3& at(int v) const { return at_[static_cast<std::size_t>(v)]; }

 private:
  void add(const Corner& corner) {
    const auto [found, is_new] = index_.try_emplace(corner.planes, static_cast<int>(at_.size()));
    if (!is_new) return;
    const auto plane = [&](std::size_t k) -> const Plane& {
      return planes_[static_cast<std::size_t>(corner.planes[k])];
    };
    planes_of_.push_back({corner.planes.begin(), corner.planes.end()});
    at_.push_back(meet(plane(0), plane(1), plane(2)).value_or(corner.at));
  }

  // Corners that are nearly one become the first of them.
  void join() {
    DisjointSets sets(at_.size());
    std::vector<std::size_t> order(at_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const Vec3 &p = at_[a], &q = at_[b];
      return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
    });
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t k = i + 1; k < order.size(); ++k) {
        const Vec3 &p = at_[order[i]], &q = at_[order[k]];
        if (q.x() - p.x() > options_.same) break;
        if ((q - p).norm() > options_.same) continue;
        const auto [a, b] = std::minmax({sets.find(order[i]), sets.find(order[k])});
        if (a == b || !is_in_planes(b, at_[a])) continue;
        sets.unite(a, b);
        planes_of_[a].insert(planes_of_[a].end(), planes_of_[b].begin(), planes_of_[b].end());
      }
    for (std::size_t v = 0; v < at_.size(); ++v) name_.push_back(static_cast<int>(sets.find(v)));
  }
  // Whether a point is near enough to all planes that meet in a corner.
  bool is_in_planes(std::size_t corner, const Vec3& p) const {
    const auto& list = planes_of_[corner];
    return std::all_of(list.begin(), list.end(), [&](int plane) {
      return std::abs(planes_[static_cast<std::size_t>(plane)].signed_distance(p)) <
             options_.off_plane;
    });
  }
  int vertex_of(const Corner& corner) const {
    return name_[static_cast<std::size_t>(index_.at(corner.planes))];
  }

  // The vertices on the line of two planes strictly between two of them, on the way.
  std::vector<int> between(int patch, int other, int from, int to) const {
    const auto found = on_line_.find(std::minmax(patch, other));
    if (found == on_line_.end()) return {};
    const Vec3& start = at_[static_cast<std::size_t>(from)];
    const Vec3 way = at_[static_cast<std::size_t>(to)] - start;
    const double length = way.norm();
    std::vector<std::pair<double, int>> inside;
    for (int v : found->second) {
      if (v == from || v == to) continue;
      const double t = way.dot(at_[static_cast<std::size_t>(v)] - start) / length;
      if (t > options_.same && t < length - options_.same) inside.push_back({t, v});
    }
    std::sort(inside.begin(), inside.end());
    std::vector<int> vertices;
    for (const auto& [t, v] : inside) vertices.push_back(v);
    return vertices;
  }

  const std::vector<CornerPolygon>& polygons_;
  const std::vector<Plane>& planes_;
  const WeldOptions& options_;
  std::map<std::array<int, 3>, int> index_;
  std::vector<Vec3> at_;
  std::vector<std::vector<int>> planes_of_;  // of each corner, and of those joined with it
  std::vector<int> name_;                    // of each corner, the first of those joined with it
  std::map<std::pair<int, int>, std::vector<int>> on_line_;  // by planes
};

}  // namespace

std::vector<Piece> weld(const std::vector<CornerPolygon>& polygons,
                        const std::vector<Plane>& planes, const WeldOptions& options) {
  const Welder welder(polygons, planes, options);
  std::vector<std::vector<Piece>> found(polygons.size());
  parallel_for(polygons.size(), [&](std::size_t k) {
    const int patch = polygons[k].patch;
    const Plane& plane = planes[static_cast<std::size_t>(patch)];
    const PlaneFrame frame = frame_of(plane);
    const std::vector<HalfEdge> edges = welder.edges_of(polygons[k]);
    std::vector<std::vector<Vec3>> holes;
    // Corners that were joined may have joined loops, or parted them.
    for (const auto& loop :
         trace_loops(edges, [&](int v) { return frame.to_plane(welder.at(v)); })) {
      std::vector<Vec3> points;
      for (std::size_t e : loop) points.push_back(welder.at(edges[e].from));
      const double area = doubled_area(flatten(points, frame)) / 2;
      if (std::abs(area) < options.min_area) continue;
      if (area > 0)
        found[k].push_back({patch, {std::move(points)}});
      else
        holes.push_back(std::move(points));
    }
    for (auto& hole : holes)
      for (Piece& piece : found[k])
        if (found[k].size() == 1 || is_around(piece.loops[0], hole, frame)) {
          piece.loops.push_back(std::move(hole));
          break;
        }
  });
  std::vector<Piece> pieces;
  for (auto& list : found) pieces.insert(pieces.end(), list.begin(), list.end());
  return pieces;
}

}  // namespace scanworld::surface
