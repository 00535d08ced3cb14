// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "cracks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "../segments.h"

namespace scanworld {

namespace {

constexpr double kOpposite = -0.95;  // cosine between the two faces of a thin thing
constexpr double kAcross = 0.7;      // cosine between what parts them and their normals

struct Edge {
  std::size_t surface;  // by index
  int a, b;
};

class CrackFinder {
 public:
  CrackFinder(const World& world, const CrackOptions& options) : world_(world), options_(options) {
    for (std::size_t s = 0; s < world.surfaces.size(); ++s) {
      add(s, world.surfaces[s].outer);
      for (const Loop& hole : world.surfaces[s].holes) add(s, hole);
    }
  }

  std::vector<Crack> find() {
    std::vector<Segment> segments;
    for (const Edge& e : edges_) segments.push_back(segment_of(e));
    for (const auto& [i, k] : near_pairs(segments, options_.max_width))
      if (edges_[i].surface != edges_[k].surface) look_at(edges_[i], edges_[k]);
    return std::move(cracks_);
  }

 private:
  void add(std::size_t surface, const Loop& loop) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Edge edge{surface, loop[k], loop[(k + 1) % loop.size()]};
      edges_.push_back(edge);
      ++sharing_[std::minmax(edge.a, edge.b)];
    }
  }

  const Vec3& at(int vertex) const { return world_.vertices[static_cast<std::size_t>(vertex)]; }
  const Surface& surface_of(const Edge& e) const { return world_.surfaces[e.surface]; }
  bool is_open(const Edge& e) const { return sharing_.at(std::minmax(e.a, e.b)) == 1; }

  Segment segment_of(const Edge& e) const { return {at(e.a), at(e.b)}; }

  void look_at(const Edge& e, const Edge& f) {
    if (std::minmax(e.a, e.b) == std::minmax(f.a, f.b)) return;
    const auto stretch = side_by_side(segment_of(e), segment_of(f));
    if (!stretch || stretch->width > options_.max_width) return;
    if (stretch->width <= options_.same_line && stretch->length > 2 * options_.same_line) {
      bool lacks = false;
      for (int v : {f.a, f.b}) lacks |= report_if_inside(e, f, v, *stretch);
      for (int v : {e.a, e.b}) lacks |= report_if_inside(f, e, v, *stretch);
      if (!lacks) report(Crack::Kind::crack, e, f, -1, *stretch);
    } else if (stretch->length > 2 * options_.max_width && (is_open(e) || is_open(f)) &&
               !are_two_faces(e, f, stretch->gap)) {
      report(Crack::Kind::crack, e, f, -1, *stretch);
    }
  }

  // Whether a vertex of f is inside e.
  bool report_if_inside(const Edge& e, const Edge& f, int vertex, const Stretch& stretch) {
    const Vec3 &a = at(e.a), &b = at(e.b), &v = at(vertex);
    const double t = (v - a).dot(b - a) / (b - a).squaredNorm();
    if (t <= 0 || t >= 1 || (v - a).norm() <= options_.same_line ||
        (v - b).norm() <= options_.same_line)
      return false;
    if (lacking_.insert({e.surface, vertex}).second)
      report(Crack::Kind::t_junction, e, f, vertex, stretch);
    return true;
  }

  bool are_two_faces(const Edge& e, const Edge& f, const Vec3& gap) const {
    const Vec3 &n = surface_of(e).plane.normal, &m = surface_of(f).plane.normal;
    return n.dot(m) < kOpposite && std::abs(gap.dot(n)) > kAcross * gap.norm();
  }

  void report(Crack::Kind kind, const Edge& e, const Edge& f, int vertex, const Stretch& stretch) {
    cracks_.push_back({kind,
                       surface_of(e).id,
                       surface_of(f).id,
                       {e.a, e.b},
                       {f.a, f.b},
                       vertex,
                       stretch.width,
                       stretch.length});
  }

  const World& world_;
  const CrackOptions& options_;
  std::vector<Edge> edges_;
  std::map<std::pair<int, int>, int> sharing_;     // how many edges have these two vertices
  std::set<std::pair<std::size_t, int>> lacking_;  // surfaces, and the vertices that they lack
  std::vector<Crack> cracks_;
};

}  // namespace

std::vector<Crack> find_cracks(const World& world, const CrackOptions& options) {
  return CrackFinder(world, options).find();
}

std::size_t count_of(const std::vector<Crack>& cracks, Crack::Kind kind) {
  return static_cast<std::size_t>(std::count_if(
      cracks.begin(), cracks.end(), [&](const Crack& crack) { return crack.kind == kind; }));
}

std::string text_of(const Crack& c) {
  const double mm = 1000;
  if (c.kind == Crack::Kind::t_junction)
    return fmt::format("T-junction: edge {}-{} of surface {} passes vertex {} of surface {}",
                       c.edge[0], c.edge[1], c.surface, c.vertex, c.other);
  return fmt::format(
      "crack: edge {}-{} of surface {} and {}-{} of surface {} run {:.2f} mm apart over {:.3f} m",
      c.edge[0], c.edge[1], c.surface, c.other_edge[0], c.other_edge[1], c.other, c.width * mm,
      c.length);
}

}  // namespace scanworld
