// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "thickness.h"

#include <algorithm>
#include <cmath>

#include "../parallel.h"
#include "../polygon.h"
#include "faces.h"

namespace scanworld {

namespace {

// Whether a face lies across the way from one point to another.
bool is_between(const Face& face, const Vec3& from, const Vec3& to) {
  const double d = face.surface->plane.signed_distance(from),
               e = face.surface->plane.signed_distance(to);
  if (d * e >= 0) return false;
  return is_inside(face.rings, face.frame.to_plane(from + (to - from) * (d / (d - e))));
}

class Pairing {
 public:
  Pairing(const World& world, const ThicknessOptions& options)
      : options_(options), faces_(faces_of(world)) {}

  // The pairs of face `a` with later ones.
  std::vector<FacePair> pairs_of(std::size_t a) const {
    std::vector<FacePair> pairs;
    for (std::size_t b = a + 1; b < faces_.size(); ++b)
      if (const auto pair = pair_of(a, b)) pairs.push_back(*pair);
    return pairs;
  }

 private:
  std::optional<FacePair> pair_of(std::size_t a, std::size_t b) const {
    const Face &p = faces_[a], &q = faces_[b];
    const Plane &plane = p.surface->plane, &other = q.surface->plane;
    if (plane.normal.dot(other.normal) > -std::cos(options_.max_angle)) return std::nullopt;
    if (!grown(p.box, options_.max).intersects(q.box)) return std::nullopt;
    const double smaller = std::min(p.area, q.area);
    if (smaller <= 0) return std::nullopt;
    const geos::Overlap overlap = geos::overlap_of(p.rings, seen_in(p.frame, q));
    if (overlap.area < options_.min_overlap * smaller) return std::nullopt;
    const Vec3 here = p.frame.to_space(overlap.inside);
    const double thickness = other.signed_distance(here) / other.normal.dot(plane.normal);
    if (thickness < options_.min || thickness > options_.max) return std::nullopt;
    const Vec3 there = here - thickness * plane.normal;
    for (std::size_t k = 0; k < faces_.size(); ++k)
      if (k != a && k != b && is_between(faces_[k], here, there)) return std::nullopt;
    return FacePair{a, b, thickness, overlap.area};
  }

  const ThicknessOptions options_;
  const std::vector<Face> faces_;
};

}  // namespace

std::vector<FacePair> pair_faces(const World& world, const ThicknessOptions& options) {
  const Pairing pairing(world, options);
  std::vector<std::vector<FacePair>> found(world.surfaces.size());
  parallel_for(found.size(), [&](std::size_t a) { found[a] = pairing.pairs_of(a); });
  std::vector<FacePair> pairs;
  for (const auto& list : found) pairs.insert(pairs.end(), list.begin(), list.end());
  return pairs;
}

void set_thickness(World& world, const std::vector<FacePair>& pairs) {
  std::vector<const FacePair*> best(world.surfaces.size());
  for (const FacePair& pair : pairs)
    for (std::size_t s : {pair.a, pair.b}) {
      const FacePair* other = best[s];
      if (!other || pair.overlap > other->overlap ||
          (pair.overlap == other->overlap && pair.thickness < other->thickness))
        best[s] = &pair;
    }
  for (std::size_t s = 0; s < best.size(); ++s)
    if (best[s]) world.surfaces[s].thickness = best[s]->thickness;
}

OptionList list_options(ThicknessOptions& o) {
  return {
      {"thickness.min", &o.min, "m", "faces nearer than this are no two sides of one thing", 0},
      {"thickness.max", &o.max, "m", "nor are those farther apart", 0},
      {"thickness.max_angle", &o.max_angle, "rad", "between the two faces of a thing", 0, 0.5},
      {"thickness.min_overlap", &o.min_overlap, "", "of the smaller face with the other", 0, 1},
  };
}

}  // namespace scanworld
