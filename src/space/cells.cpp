// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// A facet is cut with the cell that is split, so it has one cell on each side all the time, while
// the facets around it that belong to other cells alone stay as they are: their edges get T-points.
// Every facet is strictly convex: a cut adds corners where it crosses edges, and a section joins
// the pieces of each of its sides.
#include "cells.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

#include "../error.h"
#include "../mix.h"

namespace scanworld::space {
namespace {

// Of the box's half diagonal: bounds what rounding does to the distance of a vertex from a plane
// through the box, by 16 times and more.
constexpr double kRounding = 0x1p-44;

double radius_of(const Box3& box) {
  if (!(box.min().array().abs() <= kFarthest).all() ||
      !(box.max().array().abs() <= kFarthest).all())
    throw Error(Cause::bad_input,
                fmt::format("a place from ({}, {}, {}) to ({}, {}, {}) m is not within {:.0f} m",
                            box.min().x(), box.min().y(), box.min().z(), box.max().x(),
                            box.max().y(), box.max().z(), kFarthest));
  assert((box.sizes().array() > 0).all());
  return box.diagonal().norm() / 2;
}

bool is_turned_over(const ExactPlane& p, const ExactPlane& q) {
  return p.a == -q.a && p.b == -q.b && p.c == -q.c && p.d == -q.d;
}

bool is_same(const ExactPlane& p, const ExactPlane& q) {
  return p.a == q.a && p.b == q.b && p.c == q.c && p.d == q.d;
}

// The same for both sides of a plane.
std::uint64_t key_of(const ExactPlane& plane) {
  const std::int64_t first = plane.a ? plane.a : plane.b ? plane.b : plane.c;
  std::uint64_t key = 0;
  for (const std::int64_t v : {plane.a, plane.b, plane.c, plane.d})
    key = mix(key) ^ static_cast<std::uint64_t>(first < 0 ? -v : v);
  return key;
}

// Twice the area, along the normal.
Vec3 area_vector(const Vertices& vertices, const CellFacet& facet) {
  const Vec3& corner = vertices.relative(facet.vertices[0]);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < facet.vertices.size(); ++i)
    sum += (vertices.relative(facet.vertices[i - 1]) - corner)
               .cross(vertices.relative(facet.vertices[i]) - corner);
  return sum;
}

}  // namespace

CellComplex::CellComplex(const Box3& box)
    : middle_(box.center()),
      unit_(unit_for(radius_of(box))),
      certain_(radius_of(box) * kRounding),
      vertices_(unit_, middle_),
      cells_(1),
      nodes_(1),
      node_of_(1) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      add_plane(plane_through(sign < 0 ? box.min() : box.max(), sign * Vec3::Unit(axis)));
  nodes_[0].cell = 0;
  for (int p = 0; p < kBoxPlanes; ++p) {
    const int u = (p / 2 + 1) % 3, v = (p / 2 + 2) % 3;
    CellFacet facet{p, {-1, 0}, {}, {2 * u, 2 * v, 2 * u + 1, 2 * v + 1}};
    if (p % 2 == 0) std::reverse(facet.edge_planes.begin(), facet.edge_planes.end());
    for (std::size_t i = 0; i < 4; ++i)
      facet.vertices.push_back(vertex_of(p, facet.edge_planes[(i + 3) % 4], facet.edge_planes[i]));
    cells_[0].facets.push_back(static_cast<int>(facets_.size()));
    facets_.push_back(std::move(facet));
  }
}

CellComplex::Added CellComplex::add_plane(const Plane& plane) {
  ExactPlane exact =
      space::exact_plane({plane.normal, plane.offset + plane.normal.dot(middle_)}, unit_);
  const std::uint64_t key = key_of(exact);
  const int known = of_numbers_.find(key, [&](int p) {
    return is_same(planes_[at(p)], exact) || is_turned_over(planes_[at(p)], exact);
  });
  if (known >= 0) return {known, is_turned_over(planes_[at(known)], exact)};
  const int index = static_cast<int>(planes_.size());
  rounded_.push_back({exact.plane.normal, exact.plane.offset - exact.plane.normal.dot(middle_)});
  planes_.push_back(std::move(exact));
  of_numbers_.insert(key, index);
  return {index, false};
}

int CellComplex::vertex_of(int p, int q, int r) {
  const int vertex = vertices_.where_meet(planes_, {p, q, r});
  if (marks_.size() < vertices_.size()) marks_.resize(vertices_.size());
  return vertex;
}

int CellComplex::side_of_vertex(int plane, int vertex) const {
  const ExactPlane& exact = planes_[at(plane)];
  const double height = exact.plane.signed_distance(vertices_.relative(vertex));
  if (std::abs(height) > certain_) return height > 0 ? 1 : -1;
  for (const int p : vertices_.planes_of(vertex))
    if (p == plane) return 0;
  return side_of(exact, vertices_.point(vertex));
}

// Marks the cell's vertices with their sides of the plane. Whether some are on either.
bool CellComplex::tell_sides(int cell, int plane) {
  ++split_;
  bool before = false, behind = false;
  for (const int f : cells_[at(cell)].facets)
    for (const int v : facets_[at(f)].vertices) {
      Mark& mark = marks_[at(v)];
      if (mark.split == split_) continue;
      mark.split = split_;
      mark.side = side_of_vertex(plane, v);
      before |= mark.side > 0;
      behind |= mark.side < 0;
    }
  return before && behind;
}

// Cuts a facet that is on both sides of the plane: it keeps the part before, a new one gets the
// part behind, which the cell on the other side is told of. The new one's index.
int CellComplex::split_facet(int facet, int cell, int plane) {
  const int index = static_cast<int>(facets_.size());
  facets_.emplace_back();
  CellFacet &whole = facets_[at(facet)], &part = facets_.back();
  part.plane = whole.plane;
  part.cells = whole.cells;
  corners_.clear();
  edge_planes_.clear();
  const auto put_before = [&](int v, int edge_plane) {
    corners_.push_back(v);
    edge_planes_.push_back(edge_plane);
  };
  const auto put_behind = [&](int v, int edge_plane) {
    part.vertices.push_back(v);
    part.edge_planes.push_back(edge_plane);
  };
  const std::size_t count = whole.vertices.size();
  part.vertices.reserve(count + 1);
  part.edge_planes.reserve(count + 1);
  for (std::size_t i = 0; i < count; ++i) {
    const int v = whole.vertices[i], next = whole.vertices[(i + 1) % count];
    const int edge_plane = whole.edge_planes[i];
    const int side = marks_[at(v)].side, next_side = marks_[at(next)].side;
    if (side >= 0) put_before(v, side == 0 && next_side < 0 ? plane : edge_plane);
    if (side <= 0) put_behind(v, side == 0 && next_side > 0 ? plane : edge_plane);
    if (side * next_side >= 0) continue;
    const int cut = vertex_of(whole.plane, edge_plane, plane);
    marks_[at(cut)].split = split_;
    marks_[at(cut)].side = 0;
    put_before(cut, side > 0 ? plane : edge_plane);
    put_behind(cut, side < 0 ? plane : edge_plane);
  }
  whole.vertices.assign(corners_.begin(), corners_.end());
  whole.edge_planes.assign(edge_planes_.begin(), edge_planes_.end());
  for (const int other : part.cells)
    if (other >= 0 && other != cell) cells_[at(other)].facets.push_back(index);
  return index;
}

// The facet that the plane has in the cell, from the edges in the plane of those that are before
// it. Seen from outside these go round it clockwise as seen against the plane's normal, hence
// the other way round where a facet's normal points into the cell.
CellFacet CellComplex::section(const std::vector<int>& facets_before, int cell, int plane) {
  CellFacet out;
  out.plane = plane;
  int first = -1;
  for (const int f : facets_before) {
    const CellFacet& facet = facets_[at(f)];
    const std::size_t count = facet.vertices.size();
    for (std::size_t i = 0; i < count; ++i) {
      int from = facet.vertices[i], to = facet.vertices[(i + 1) % count];
      if (marks_[at(from)].side != 0 || marks_[at(to)].side != 0) continue;
      if (facet.cells[0] == cell) std::swap(from, to);
      marks_[at(from)].next = to;
      marks_[at(from)].edge_plane = facet.plane;
      first = from;
    }
  }
  // Pieces of one side of it become one edge.
  int edge_plane = -1;
  for (int v = first; edge_plane < 0 || v != first; v = marks_[at(v)].next) {
    const Mark& mark = marks_[at(v)];
    if (mark.edge_plane == edge_plane) continue;
    edge_plane = mark.edge_plane;
    out.vertices.push_back(v);
    out.edge_planes.push_back(edge_plane);
  }
  if (out.edge_planes.front() == out.edge_planes.back()) {
    out.vertices.erase(out.vertices.begin());
    out.edge_planes.erase(out.edge_planes.begin());
  }
  assert(out.vertices.size() >= 3);
  return out;
}

bool CellComplex::split(int cell, int plane) {
  if (!tell_sides(cell, plane)) return false;
  before_.clear();
  behind_.clear();
  for (const int f : cells_[at(cell)].facets) {
    bool before = false, behind = false;
    for (const int v : facets_[at(f)].vertices) {
      before |= marks_[at(v)].side > 0;
      behind |= marks_[at(v)].side < 0;
    }
    if (before) before_.push_back(f);
    if (behind) behind_.push_back(before ? split_facet(f, cell, plane) : f);
  }
  CellFacet between = section(before_, cell, plane);
  const int other = static_cast<int>(cells_.size()), facet = static_cast<int>(facets_.size());
  between.cells = {cell, other};
  facets_.push_back(std::move(between));
  for (const int f : behind_)
    for (int& side : facets_[at(f)].cells)
      if (side == cell) side = other;
  before_.push_back(facet);
  behind_.push_back(facet);
  cells_[at(cell)].facets.assign(before_.begin(), before_.end());
  cells_.push_back({behind_});

  const int node = node_of_[at(cell)], below = static_cast<int>(nodes_.size());
  nodes_[at(node)] = {plane, {below, below + 1}, -1};
  nodes_.push_back({-1, {-1, -1}, cell});
  nodes_.push_back({-1, {-1, -1}, other});
  node_of_[at(cell)] = below;
  node_of_.push_back(below + 1);
  return true;
}

int CellComplex::leaf_below(int node, const Vec3& relative) const {
  while (nodes_[at(node)].plane >= 0)
    node = nodes_[at(node)].child[is_behind(nodes_[at(node)], relative)];
  return nodes_[at(node)].cell;
}

int CellComplex::cell_at(const Vec3& place) const { return leaf_below(0, place - middle_); }

std::optional<std::array<int, 2>> CellComplex::sides_at(const Vec3& place, int plane) const {
  const Vec3 relative = place - middle_;
  if (plane < kBoxPlanes) return {{-1, leaf_below(0, relative)}};
  int node = 0;
  while (nodes_[at(node)].plane != plane) {
    if (nodes_[at(node)].plane < 0) return std::nullopt;
    node = nodes_[at(node)].child[is_behind(nodes_[at(node)], relative)];
  }
  const auto& child = nodes_[at(node)].child;
  return {{leaf_below(child[0], relative), leaf_below(child[1], relative)}};
}

Vec3 CellComplex::middle_of(const CellFacet& facet) const {
  Vec3 middle = Vec3::Zero();
  for (const int v : facet.vertices)
    middle += vertex(v) / static_cast<double>(facet.vertices.size());
  return middle;
}

double CellComplex::area_of(const CellFacet& facet) const {
  return area_vector(vertices_, facet).norm() / 2;
}

// The pyramids over its facets, seen from one of its corners.
double CellComplex::volume_of(int cell) const {
  const std::vector<int>& facets = cells_[at(cell)].facets;
  const Vec3& top = vertices_.relative(facets_[at(facets[0])].vertices[0]);
  double sum = 0;
  for (const int f : facets) {
    const CellFacet& facet = facets_[at(f)];
    const double pyramid =
        area_vector(vertices_, facet).dot(vertices_.relative(facet.vertices[0]) - top);
    sum += facet.cells[1] == cell ? pyramid : -pyramid;
  }
  return sum / 6;
}

std::array<std::vector<Vec3>, 2> parts_of(const std::vector<Vec3>& polygon, const Plane& plane,
                                          double tolerance) {
  std::array<std::vector<Vec3>, 2> parts;
  Vec3 last = polygon.back();
  double last_height = plane.signed_distance(last);
  for (const Vec3& p : polygon) {
    const double height = plane.signed_distance(p);
    if (std::min(height, last_height) < -tolerance && std::max(height, last_height) > tolerance) {
      const Vec3 cut = last + (p - last) * (last_height / (last_height - height));
      for (auto& part : parts) part.push_back(cut);
    }
    if (height >= -tolerance) parts[0].push_back(p);
    if (height <= tolerance) parts[1].push_back(p);
    last = p;
    last_height = height;
  }
  return parts;
}

}  // namespace scanworld::space
