// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "shared_edges.h"

#include <algorithm>
#include <cmath>

#include "../disjoint_sets.h"
#include "../parallel.h"

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

// How far off an edge's plane the places are that may be its reveal's, behind the faces.
std::vector<double> offsets_of_reveal(const SharedEdge& edge, const std::vector<Patch>& patches,
                                      const Surroundings& around,
                                      const SharedEdgeOptions& options) {
  Box3 box;
  for (const SharedEdge::Part& part : edge.parts) box.extend(part.from), box.extend(part.to);
  const Eigen::AlignedBox3f reach =
      grown(box, options.reveal_depth + options.reveal_reach).cast<float>();
  const auto is_behind = [&](const SharedEdge::Part& part, const Vec3& p, double clearance) {
    const double depth = -patches[static_cast<std::size_t>(part.patch)].plane.signed_distance(p);
    const Vec3 way = part.to - part.from;
    const double t = way.dot(p - part.from) / way.squaredNorm();
    return depth > clearance && depth < options.reveal_depth && t > 0 && t < 1;
  };
  std::vector<double> off;
  for (std::size_t run = 0; run < around.boxes.size(); ++run) {
    if (!reach.intersects(around.boxes[run])) continue;
    const std::size_t begin = run * Surroundings::kRun;
    for (std::size_t i = begin; i < std::min(begin + Surroundings::kRun, around.points.size());
         ++i) {
      const Vec3 p = around.points[i].cast<double>();
      const double distance = edge.plane.signed_distance(p);
      if (std::abs(distance) > options.reveal_reach) continue;
      // What belongs to another surface is none of its reveal: that would be a seam.
      if (around.planes[i] >= 0) continue;
      if (std::any_of(edge.parts.begin(), edge.parts.end(), [&](const SharedEdge::Part& part) {
            return is_behind(part, p, patches[static_cast<std::size_t>(part.patch)].hit.cell / 2);
          }))
        off.push_back(distance);
    }
  }
  return off;
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

std::vector<SharedEdge> move_to_reveals(std::vector<SharedEdge> edges,
                                        const std::vector<Patch>& patches,
                                        const Surroundings& around,
                                        const SharedEdgeOptions& options) {
  parallel_for(edges.size(), [&](std::size_t k) {
    std::vector<double> off = offsets_of_reveal(edges[k], patches, around, options);
    if (off.size() < static_cast<std::size_t>(options.reveal_sites)) return;
    std::sort(off.begin(), off.end());
    const std::size_t n = off.size();
    if (off[n - 1 - n / 4] - off[n / 4] < options.reveal_spread)
      edges[k].plane.offset -= (off[n / 2] + off[(n - 1) / 2]) / 2;
  });
  return edges;
}

}  // namespace scanworld::surface
