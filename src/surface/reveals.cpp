// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "reveals.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "cut_line.h"

namespace scanworld::surface {

namespace {

// Where a face ends along a free edge.
struct End {
  int face = 0;
  struct Tip {
    int plane = 0;  // the third one that meets there
    double t = 0;   // [m] along the edge
  };
  Tip low, high;
  Vec3 outward = Vec3::Zero();  // away from the face, square to its edge
};

class RevealMaker {
 public:
  RevealMaker(const Pieces& pieces, const RevealOptions& options)
      : pieces_(pieces), options_(options) {}

  std::vector<CornerPolygon> make() {
    std::map<int, std::vector<End>> ends;  // by the plane of their edge
    for (const CornerPolygon& polygon : pieces_.polygons)
      for (const auto& loop : polygon.loops)
        for (std::size_t k = 0; k < loop.size(); ++k)
          if (pieces_.is_edge(loop[k].next))
            if (const auto end = end_of(polygon.patch, loop[k], loop[(k + 1) % loop.size()]))
              ends[loop[k].next].push_back(*end);
    std::vector<CornerPolygon> reveals;
    for (const auto& [edge, list] : ends)
      for (std::size_t i = 0; i < list.size(); ++i)
        for (std::size_t k = i + 1; k < list.size(); ++k)
          if (const auto reveal = between(edge, list[i], list[k])) reveals.push_back(*reveal);
    return reveals;
  }

 private:
  const Plane& plane(int k) const { return pieces_.planes[static_cast<std::size_t>(k)]; }

  // Along the edge, by which both faces tell places alike.
  Vec3 way_of(int edge, int face) const {
    const Vec3 way = plane(edge).normal.cross(plane(face).normal).normalized();
    Eigen::Index axis = 0;
    way.cwiseAbs().maxCoeff(&axis);
    return way[axis] < 0 ? Vec3(-way) : way;
  }

  static int third_of(const Corner& corner, int face, int edge) {
    for (int plane : corner.planes)
      if (plane != face && plane != edge) return plane;
    return -1;
  }

  std::optional<End> end_of(int face, const Corner& from, const Corner& to) const {
    const int edge = from.next;
    const Vec3 way = way_of(edge, face);
    End end{.face = face,
            .low = {third_of(from, face, edge), way.dot(from.at)},
            .high = {third_of(to, face, edge), way.dot(to.at)},
            .outward = (to.at - from.at).cross(plane(face).normal).normalized()};
    if (end.low.t > end.high.t) std::swap(end.low, end.high);
    if (end.low.plane < 0 || end.high.plane < 0) return std::nullopt;
    return end;
  }

  std::optional<CornerPolygon> between(int edge, const End& a, const End& b) const {
    if (plane(a.face).normal.dot(plane(b.face).normal) > -std::cos(options_.max_tilt) ||
        a.outward.dot(b.outward) < 0)
      return std::nullopt;
    // The end of the shorter one, where they differ.
    const End::Tip low = a.low.t > b.low.t ? a.low : b.low,
                   high = a.high.t < b.high.t ? a.high : b.high;
    if (high.t - low.t < options_.min_length) return std::nullopt;
    const std::array<std::array<int, 2>, 4> places = {
        {{a.face, low.plane}, {a.face, high.plane}, {b.face, high.plane}, {b.face, low.plane}}};
    const std::array<int, 4> next = {a.face, high.plane, b.face, low.plane};
    std::vector<Corner> loop;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto at = meet(plane(places[k][0]), plane(edge), plane(places[k][1]));
      if (!at) return std::nullopt;
      Corner corner{{places[k][0], edge, places[k][1]}, next[k], *at};
      std::sort(corner.planes.begin(), corner.planes.end());
      loop.push_back(corner);
    }
    // The faces look away from each other, the wall is between them.
    for (std::size_t k : {0u, 1u}) {
      const double thickness = -plane(a.face).signed_distance(loop[3 - k].at);
      if (thickness < options_.min_thickness || thickness > options_.max_thickness)
        return std::nullopt;
    }
    const Vec3 area = (loop[2].at - loop[0].at).cross(loop[3].at - loop[1].at);
    if (area.norm() < 2 * options_.min_length * options_.min_thickness) return std::nullopt;
    if (area.dot(plane(edge).normal) < 0) {
      std::reverse(loop.begin(), loop.end());
      for (std::size_t k = 0; k < 4; ++k) loop[k].next = next[(6 - k) % 4];
    }
    return CornerPolygon{edge, {std::move(loop)}};
  }

  const Pieces& pieces_;
  const RevealOptions& options_;
};

}  // namespace

Pieces add_reveals(Pieces pieces, const RevealOptions& options) {
  const std::vector<CornerPolygon> reveals = RevealMaker(pieces, options).make();
  pieces.polygons.insert(pieces.polygons.end(), reveals.begin(), reveals.end());
  return pieces;
}

}  // namespace scanworld::surface
