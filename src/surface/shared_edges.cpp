// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "shared_edges.h"

#include <algorithm>
#include <cmath>

#include "../disjoint_sets.h"

namespace scanworld::surface {

namespace {

Box3 box_of(const FreeEdge& e) {
  Box3 box(e.from);
  return box.extend(e.to);
}

// Whether two edges are parts of one: their planes are nearly one, and they run side by side.
bool are_one(const FreeEdge& a, const FreeEdge& b, const SharedEdgeOptions& options) {
  const Vec3 way = (a.to - a.from).normalized(), other = (b.to - b.from).normalized();
  const Vec3 middle_a = (a.from + a.to) / 2, middle_b = (b.from + b.to) / 2;
  return std::abs(a.plane.normal.dot(b.plane.normal)) > std::cos(options.max_angle) &&
         std::abs(way.dot(other)) > 0.9 &&
         std::abs(a.plane.signed_distance(middle_b)) < options.max_offset &&
         std::abs(b.plane.signed_distance(middle_a)) < options.max_offset;
}

// The plane of several edges, each by its length.
Plane mean_plane(const std::vector<FreeEdge>& edges, const std::vector<std::size_t>& group) {
  const Vec3& first = edges[group[0]].plane.normal;
  Vec3 normal = Vec3::Zero(), middle = Vec3::Zero();
  double sum = 0;
  for (std::size_t i : group) {
    const FreeEdge& e = edges[i];
    const double length = (e.to - e.from).norm();
    normal += (e.plane.normal.dot(first) < 0 ? -length : length) * e.plane.normal;
    middle += length * (e.from + e.to) / 2, sum += length;
  }
  return plane_through(middle / sum, normal.normalized());
}

// Where an edge that ends near a seam goes on: in the seam's other patch.
void carry_over(const FreeEdge& edge, const std::vector<Patch>& patches,
                const std::vector<const Seam*>& seams, const SharedEdgeOptions& options,
                SharedEdge& shared) {
  for (const Seam* seam : seams) {
    const int other = seam->a == edge.patch ? seam->b : seam->a;
    const Patch& patch = patches[static_cast<std::size_t>(other)];
    const auto line = intersect(patch.plane, shared.plane, 0.5);
    if (!line) continue;
    for (const Vec3& end : {edge.from, edge.to}) {
      const double t = seam->line.direction.dot(end);
      const bool is_near =
          (seam->line.at(t) - end).norm() < options.reach &&
          std::any_of(seam->seen.begin(), seam->seen.end(), [&](const Interval& i) {
            return t > i.low - options.reach && t < i.high + options.reach;
          });
      if (!is_near) continue;
      const double s = line->direction.dot(end);
      shared.parts.push_back({other, line->at(s - options.length), line->at(s + options.length)});
    }
  }
}

}  // namespace

std::vector<SharedEdge> share_edges(const std::vector<FreeEdge>& edges,
                                    const std::vector<Patch>& patches,
                                    const std::vector<Seam>& seams,
                                    const SharedEdgeOptions& options) {
  DisjointSets sets(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Box3 near = grown(box_of(edges[i]), options.max_gap);
    for (std::size_t j = i + 1; j < edges.size(); ++j)
      if (!sets.are_joined(i, j) && near.intersects(box_of(edges[j])) &&
          are_one(edges[i], edges[j], options))
        sets.unite(i, j);
  }
  std::vector<std::vector<std::size_t>> groups(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) groups[sets.find(i)].push_back(i);
  std::vector<std::vector<const Seam*>> seams_of(patches.size());
  for (const Seam& seam : seams)
    for (int patch : {seam.a, seam.b}) seams_of[static_cast<std::size_t>(patch)].push_back(&seam);
  std::vector<SharedEdge> shared;
  for (const auto& group : groups) {
    if (group.empty()) continue;
    SharedEdge edge{mean_plane(edges, group), {}};
    for (std::size_t i : group) edge.parts.push_back({edges[i].patch, edges[i].from, edges[i].to});
    for (std::size_t i : group)
      carry_over(edges[i], patches, seams_of[static_cast<std::size_t>(edges[i].patch)], options,
                 edge);
    shared.push_back(std::move(edge));
  }
  return shared;
}

}  // namespace scanworld::surface
