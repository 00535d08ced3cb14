// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "weld.h"

#include <algorithm>
#include <cmath>

#include "../parallel.h"
#include "../polygon.h"
#include "../segments.h"
#include "trace_loops.h"
#include "welder.h"

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

// An edge in the plane of its polygon.
struct FlatEdge {
  int from, to;
  Vec2 a, b;

  Vec2 low() const { return a.cwiseMin(b); }
  Vec2 high() const { return a.cwiseMax(b); }
};

constexpr double kTouch = 3e-6;  // [m] what rounding to micrometres can make one

// Whether two edges of a polygon cross, or touch elsewhere than in a vertex that they share.
bool do_clash(const FlatEdge& e, const FlatEdge& f) {
  if ((e.high() - f.low()).minCoeff() < -kTouch || (f.high() - e.low()).minCoeff() < -kTouch)
    return false;
  const auto touches = [](int v, const Vec2& at, const FlatEdge& edge) {
    return v != edge.from && v != edge.to && distance_to(at, edge.a, edge.b) < kTouch;
  };
  return do_cross(e.a, e.b, f.a, f.b) || touches(e.from, e.a, f) || touches(e.to, e.b, f) ||
         touches(f.from, f.a, e) || touches(f.to, f.b, e);
}

// Gives edges the vertices of others' that go along them: those that lie on lines of other planes.
class EdgeSplitter {
 public:
  EdgeSplitter(const std::vector<CornerPolygon>& polygons, const std::vector<Plane>& planes,
               const WeldOptions& options, Welder& welder, std::vector<std::vector<HalfEdge>> edges)
      : polygons_(polygons),
        planes_(planes),
        options_(options),
        welder_(welder),
        edges_(std::move(edges)) {}

  std::vector<std::vector<HalfEdge>> run() {
    std::vector<HalfEdge> all;
    std::vector<Segment> segments;
    for (std::size_t k = 0; k < edges_.size(); ++k)
      for (HalfEdge& e : edges_[k]) {
        e.tag = static_cast<int>(all.size());
        all.push_back(e);
        owner_.push_back(k);
        segments.push_back({welder_.at(e.from), welder_.at(e.to)});
      }
    for (const auto& [e, f] : near_pairs(segments, options_.same)) {
      const auto stretch = side_by_side(segments[e], segments[f]);
      if (!stretch || stretch->width > options_.same ||
          stretch->length < 2 * std::max(stretch->width, options_.off_plane))
        continue;
      for (int v : {all[f].from, all[f].to}) put(v, e);
      for (int v : {all[e].from, all[e].to}) put(v, f);
    }
    return std::move(edges_);
  }

 private:
  // Puts a vertex on an edge that it is inside of, if the polygon has room for it.
  void put(int v, std::size_t e) {
    const CornerPolygon& polygon = polygons_[owner_[e]];
    std::vector<HalfEdge>& edges = edges_[owner_[e]];
    const auto edge = std::find_if(edges.begin(), edges.end(), [&](const HalfEdge& part) {
      return part.tag == static_cast<int>(e) && is_inside(v, part);
    });
    if (edge == edges.end() || !welder_.bring(v, polygon.patch)) return;
    const PlaneFrame frame = frame_of(planes_[static_cast<std::size_t>(polygon.patch)]);
    const HalfEdge before{edge->from, v, edge->tag}, after{v, edge->to, edge->tag};
    const auto flat = [&](const HalfEdge& half) {
      return FlatEdge{half.from, half.to, frame.to_plane(welder_.at(half.from)),
                      frame.to_plane(welder_.at(half.to))};
    };
    const FlatEdge first = flat(before), second = flat(after);
    for (const HalfEdge& other : edges) {
      if (&other == &*edge) continue;
      const FlatEdge third = flat(other);
      if (do_clash(first, third) || do_clash(second, third)) return;
    }
    *edge = before;
    edges.insert(edge + 1, after);
  }

  bool is_inside(int v, const HalfEdge& edge) const {
    const Vec3 &from = welder_.at(edge.from), &to = welder_.at(edge.to), &at = welder_.at(v);
    const double t = (at - from).dot(to - from) / (to - from).squaredNorm();
    return t > 0 && t < 1 && (at - from).norm() > options_.off_plane &&
           (at - to).norm() > options_.off_plane;
  }

  const std::vector<CornerPolygon>& polygons_;
  const std::vector<Plane>& planes_;
  const WeldOptions& options_;
  Welder& welder_;
  std::vector<std::vector<HalfEdge>> edges_;  // of each polygon, tagged by what they are part of
  std::vector<std::size_t> owner_;            // the polygon of each edge, before any was split
};

// Loops of vertices in a polygon's plane, and where they are in it.
struct Loops {
  std::vector<std::vector<int>> vertices;
  std::vector<std::vector<Vec2>> flat;
  bool are_simple = true;  // cross neither themselves nor each other
};

bool are_simple(const Loops& loops) {
  std::vector<FlatEdge> edges;
  for (std::size_t l = 0; l < loops.vertices.size(); ++l) {
    const std::vector<int>& loop = loops.vertices[l];
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::size_t next = (k + 1) % loop.size();
      edges.push_back({loop[k], loop[next], loops.flat[l][k], loops.flat[l][next]});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const FlatEdge& e, const FlatEdge& f) { return e.low().x() < f.low().x(); });
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t k = i + 1;
         k < edges.size() && edges[k].low().x() < edges[i].high().x() + kTouch; ++k)
      if (do_clash(edges[i], edges[k])) return false;
  return true;
}

Loops find_loops(const std::vector<HalfEdge>& edges, const Welder& welder, const PlaneFrame& frame,
                 double min_area) {
  const auto flat = [&](int v) { return frame.to_plane(welder.at(v)); };
  Loops loops;
  // Corners that were joined may have joined loops, or parted them.
  for (const auto& loop : trace_loops(edges, flat)) {
    std::vector<int> vertices;
    std::vector<Vec2> points;
    for (std::size_t e : loop)
      vertices.push_back(edges[e].from), points.push_back(flat(edges[e].from));
    if (std::abs(doubled_area(points)) / 2 < min_area) continue;
    loops.vertices.push_back(std::move(vertices));
    loops.flat.push_back(std::move(points));
  }
  loops.are_simple = are_simple(loops);
  return loops;
}

// The pieces of a polygon: outer loops, with the holes in them.
std::vector<Piece> pieces_of(int patch, const Loops& loops, const Welder& welder,
                             const PlaneFrame& frame) {
  std::vector<Piece> pieces;
  std::vector<std::vector<Vec3>> holes;
  for (std::size_t k = 0; k < loops.vertices.size(); ++k) {
    std::vector<Vec3> points;
    for (int v : loops.vertices[k]) points.push_back(welder.at(v));
    if (doubled_area(loops.flat[k]) > 0)
      pieces.push_back({patch, {std::move(points)}});
    else
      holes.push_back(std::move(points));
  }
  for (auto& hole : holes)
    for (Piece& piece : pieces)
      if (pieces.size() == 1 || is_around(piece.loops[0], hole, frame)) {
        piece.loops.push_back(std::move(hole));
        break;
      }
  return pieces;
}

}  // namespace

std::vector<Piece> weld(const std::vector<CornerPolygon>& polygons,
                        const std::vector<Plane>& planes, const WeldOptions& options) {
  Welder welder(polygons, planes, options);
  std::vector<std::vector<HalfEdge>> joined;
  for (const CornerPolygon& polygon : polygons) joined.push_back(welder.edges_of(polygon));
  const std::vector<std::vector<HalfEdge>> split =
      EdgeSplitter(polygons, planes, options, welder, joined).run();
  std::vector<std::vector<Piece>> found(polygons.size());
  parallel_for(polygons.size(), [&](std::size_t k) {
    const int patch = polygons[k].patch;
    const PlaneFrame frame = frame_of(planes[static_cast<std::size_t>(patch)]);
    Loops loops = find_loops(split[k], welder, frame, options.min_area);
    if (!loops.are_simple) loops = find_loops(joined[k], welder, frame, options.min_area);
    if (!loops.are_simple)
      loops = find_loops(welder.lone_edges_of(polygons[k]), welder, frame, options.min_area);
    found[k] = pieces_of(patch, loops, welder, frame);
  });
  std::vector<Piece> pieces;
  for (auto& list : found) pieces.insert(pieces.end(), list.begin(), list.end());
  return pieces;
}

}  // namespace scanworld::surface
