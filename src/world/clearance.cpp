// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "clearance.h"

#include <algorithm>

#include "../parallel.h"
#include "../polygon.h"

namespace scanworld {

namespace {

constexpr double kSameWay = 0.17;  // cosine from which two faces look the same way (80 degrees)
constexpr double kOpposed = -0.7;  // cosine up to which they are opposed (135 degrees)
constexpr double kParallel = -0.985;  // and the two sides of one thing (170 degrees)

}  // namespace

Clearance::Clearance(const std::vector<Face>& faces, const ClearanceOptions& options)
    : faces_(faces), options_(options), triangles_(faces.size()) {
  parallel_for(faces.size(), [&](std::size_t i) {
    if (faces[i].area <= 0) return;
    const auto flat = geos::triangulate(faces[i].rings);
    if (!flat) return;
    for (const auto& t : *flat)
      triangles_[i].push_back({faces[i].frame.to_space(t[0]), faces[i].frame.to_space(t[1]),
                               faces[i].frame.to_space(t[2])});
  });
}

std::optional<Clearance::Found> Clearance::find(const Slab& slab, std::size_t face) const {
  Found found{slab.depth, 0, std::vector<double>(slab.sides.size())};
  bool any = false;
  const Vec2 low = slab.bounds.min(), high = slab.bounds.max();
  for (const auto& triangle : triangles_[face]) {
    std::vector<Vec3> ring;
    Box3 box;
    for (const Vec3& p : triangle) ring.push_back(slab.to_slab(p)), box.extend(ring.back());
    if (box.max().z() < 0 || box.min().z() > slab.depth ||
        (box.min().head<2>().array() > high.array()).any() ||
        (box.max().head<2>().array() < low.array()).any())
      continue;
    ring = clipped(ring, {0, 0, -1}, 0.0);
    ring = clipped(ring, {0, 0, 1}, slab.depth - options_.tolerance);
    for (int k = 0; k < 2 && !ring.empty(); ++k) {
      ring = clipped(ring, Vec3(Vec3::Unit(k)), high[k] - options_.tolerance);
      ring = clipped(ring, Vec3(-Vec3::Unit(k)), -low[k] - options_.tolerance);
    }
    for (const Slab::Side& side : slab.sides)
      ring = clipped(ring, {side.normal.x(), side.normal.y(), 0}, side.offset - options_.tolerance);
    for (const Vec3& p : ring) {
      any = true;
      found.depth = std::min(found.depth, p.z());
      found.deepest = std::max(found.deepest, p.z());
      for (std::size_t i = 0; i < slab.sides.size(); ++i) {
        const Slab::Side& side = slab.sides[i];
        // Up to where the surface would be a tolerance beyond the side.
        found.cut[i] =
            std::max(found.cut[i], side.offset - side.normal.dot(p.head<2>()) - options_.tolerance);
      }
    }
  }
  if (!any) return std::nullopt;
  return found;
}

void Clearance::fit(Slab& slab) const {
  const Vec3 normal = slab.normal();
  for (const bool opposed : {true, false}) {
    const Box3 box = slab.box();
    for (std::size_t k = 0; k < faces_.size(); ++k) {
      if (k == slab.surface || !faces_[k].box.intersects(box)) continue;
      const double cosine = faces_[k].normal().dot(normal);
      if (cosine > kSameWay || (cosine < kOpposed) != opposed) continue;
      const auto found = find(slab, k);
      if (!found || (cosine > kParallel && found->deepest < options_.poke)) continue;
      std::size_t best = 0;
      for (std::size_t i = 1; i < slab.sides.size(); ++i)
        if (found->cut[i] - slab.sides[i].slack < found->cut[best] - slab.sides[best].slack)
          best = i;
      Slab::Side& side = slab.sides[best];
      if (found->cut[best] <= side.slack) {
        side.offset -= found->cut[best];
        side.slack -= found->cut[best];
      } else if (opposed || found->depth > options_.poke) {
        slab.depth = std::max(found->depth, options_.least_depth);
      }
      // Else it goes through the face itself: the two contradict each other, and nothing can be
      // said about what is behind.
    }
  }
}

bool Clearance::fits(const Slab& slab) const {
  Slab fitted = slab;
  for (Slab::Side& side : fitted.sides) side.slack = 0;
  fit(fitted);
  return fitted.depth == slab.depth;
}

}  // namespace scanworld
