// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Space, cut into convex cells by planes: a binary space partition whose topology is exact. Planes
// are rounded to whole numbers, a vertex is where three of them meet, and on which side of a fourth
// it lies is told without rounding. So neighbours share their vertices, and nothing gapes.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "../types.h"
#include "exact.h"
#include "vertices.h"

namespace scanworld::space {

// A convex polygon between two cells. An edge may carry corners of other facets: T-points.
struct CellFacet {
  int plane = 0;
  std::array<int, 2> cells{};    // before it, where its plane's normal points, and behind; -1: none
  std::vector<int> vertices;     // counter-clockwise seen against the plane's normal
  std::vector<int> edge_planes;  // the other plane of the edge from each vertex to the next
};

struct Cell {
  std::vector<int> facets;
};

// A node of the tree: an inner one has a plane, a leaf a cell.
struct CellNode {
  int plane = -1;
  std::array<int, 2> child = {-1, -1};  // before and behind the plane
  int cell = -1;
};

class CellComplex {
 public:
  static constexpr int kBoxPlanes = 6;  // the first ones are the box's, normals outwards

  // One cell. Planes may be no farther from the box's middle than four times its half diagonal.
  // Throws Error where the box is not within kFarthest.
  explicit CellComplex(const Box3& box);

  struct Added {
    int plane;        // its index
    bool is_flipped;  // it was there already, looking the other way
  };

  // Rounds a plane to whole numbers; it cuts nothing yet.
  Added add_plane(const Plane& plane);

  // Cuts a cell by a plane; false where the plane leaves it whole. The part before the plane keeps
  // the cell's number, the part behind it gets the next free one.
  bool split(int cell, int plane);

  // The cell around a place; of places outside of the box a cell at its border.
  int cell_at(const Vec3& place) const;

  // The cells before and behind a place on a plane, where the plane parts cells there; -1 before
  // the box's.
  std::optional<std::array<int, 2>> sides_at(const Vec3& place, int plane) const;

  // Calls visit(cell, t0, t1, plane) for the cells along a segment in order, each with the part of
  // the segment that is in it, 0 to 1, and the plane it is entered through, -1 at first, until
  // visit returns false. The plane `skip` is never crossed: one goes on along the side where the
  // segment begins. Outside of the box cells at its border go on.
  template <typename Visit>
  void walk(const Vec3& from, const Vec3& to, int skip, const Visit& visit) const;

  // Calls visit(cell, part) with the parts of a convex polygon that are in the cells, each once.
  // What lies in a plane that parts cells there, within kOnPlane, is in none. Like that of `walk`,
  // visit may not split.
  template <typename Visit>
  void clip(const std::vector<Vec3>& polygon, const Visit& visit) const;
  static constexpr double kOnPlane = 1e-6;  // [m]

  const std::vector<Cell>& cells() const { return cells_; }
  const std::vector<CellFacet>& facets() const { return facets_; }
  const std::vector<CellNode>& nodes() const { return nodes_; }  // the root first
  std::size_t plane_count() const { return planes_.size(); }
  const Plane& plane(int index) const { return rounded_[at(index)]; }     // as rounded
  const Vec3& vertex(int index) const { return vertices_.place(index); }  // rounded to double
  std::size_t vertex_count() const { return vertices_.size(); }
  Vec3 middle_of(const CellFacet& facet) const;  // the mean of its vertices
  double area_of(const CellFacet& facet) const;  // [m2]
  double volume_of(int cell) const;              // [m3]

  // In whole numbers, relative to the box's middle.
  const ExactPlane& exact_plane(int index) const { return planes_[at(index)]; }
  const ExactPoint& exact_vertex(int index) const { return vertices_.point(index); }

 private:
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }
  // On which side of the plane of an inner node a place lies: the child's index.
  bool is_behind(const CellNode& node, const Vec3& relative) const {
    return planes_[at(node.plane)].plane.signed_distance(relative) < 0;
  }
  int leaf_below(int node, const Vec3& relative) const;
  int vertex_of(int p, int q, int r);
  int side_of_vertex(int plane, int vertex) const;
  bool tell_sides(int cell, int plane);
  int split_facet(int facet, int cell, int plane);
  CellFacet section(const std::vector<int>& facets_before, int cell, int plane);

  Vec3 middle_;     // of the box, the zero point of planes_
  double unit_;     // [m]
  double certain_;  // [m] farther from a plane, doubles tell a vertex's side
  std::vector<ExactPlane> planes_;
  std::vector<Plane> rounded_;  // in the caller's coordinates
  NumberTable of_numbers_;      // planes
  Vertices vertices_;
  std::vector<Cell> cells_;
  std::vector<CellFacet> facets_;
  std::vector<CellNode> nodes_;
  std::vector<int> node_of_;  // of each cell

  // Of the split under way, kept for their memory.
  struct Mark {
    int split = -1;                  // the one that it was made in
    int side = 0;                    // of the plane that splits
    int next = -1, edge_plane = -1;  // the edge of the section that begins here
  };
  std::vector<Mark> marks_;  // of each vertex
  int split_ = 0;
  std::vector<int> before_, behind_, corners_, edge_planes_;
};

template <typename Visit>
void CellComplex::walk(const Vec3& from, const Vec3& to, int skip, const Visit& visit) const {
  struct Stretch {
    int node;
    double t0, t1;
    int plane;
  };
  std::vector<Stretch> ahead;
  ahead.reserve(64);
  ahead.push_back({0, 0, 1, -1});
  bool is_first = true;
  const Vec3 start = from - middle_, way = to - from;
  while (!ahead.empty()) {
    Stretch s = ahead.back();
    ahead.pop_back();
    while (nodes_[at(s.node)].plane >= 0) {
      const CellNode& node = nodes_[at(s.node)];
      const Plane& plane = planes_[at(node.plane)].plane;
      const double height = plane.signed_distance(start), rise = plane.normal.dot(way);
      const double h0 = height + s.t0 * rise, h1 = height + s.t1 * rise;
      const bool crosses = node.plane != skip && (h0 < 0) != (h1 < 0);
      const bool behind = node.plane == skip ? height < 0 : h0 < 0;
      if (crosses) {
        const double t = std::clamp(s.t0 + (s.t1 - s.t0) * (h0 / (h0 - h1)), s.t0, s.t1);
        ahead.push_back({node.child[!behind], t, s.t1, node.plane});
        s.t1 = t;
      }
      s.node = node.child[behind];
    }
    if (s.t0 >= s.t1) continue;  // no more than a corner of the cell
    if (!visit(nodes_[at(s.node)].cell, s.t0, s.t1, is_first ? -1 : s.plane)) return;
    is_first = false;
  }
}

// The parts of a convex polygon before and behind a plane that it crosses. A corner on the plane,
// within `tolerance`, is one of both parts, as it is.
std::array<std::vector<Vec3>, 2> parts_of(const std::vector<Vec3>& polygon, const Plane& plane,
                                          double tolerance);

template <typename Visit>
void CellComplex::clip(const std::vector<Vec3>& polygon, const Visit& visit) const {
  std::vector<std::pair<int, std::vector<Vec3>>> ahead;
  ahead.emplace_back(0, polygon);
  while (!ahead.empty()) {
    auto [index, part] = std::move(ahead.back());
    ahead.pop_back();
    bool lies_in_plane = false;
    while (nodes_[at(index)].plane >= 0 && !lies_in_plane) {
      const CellNode& node = nodes_[at(index)];
      bool before = false, behind = false;
      for (const Vec3& p : part) {
        const double height = rounded_[at(node.plane)].signed_distance(p);
        before |= height > kOnPlane;
        behind |= height < -kOnPlane;
      }
      if (before && behind) {
        auto parts = parts_of(part, rounded_[at(node.plane)], kOnPlane);
        ahead.emplace_back(node.child[1], std::move(parts[1]));
        part = std::move(parts[0]);
      }
      lies_in_plane = !before && !behind;
      index = node.child[!before];
    }
    if (!lies_in_plane) visit(nodes_[at(index)].cell, part);
  }
}

}  // namespace scanworld::space
