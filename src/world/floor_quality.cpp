// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "floor_quality.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "../disjoint_sets.h"
#include "../parallel.h"
#include "../polygon.h"
#include "faces.h"

namespace scanworld {

namespace {

constexpr double kAcrossGap = 0.8;  // cosine between the way over a gap and square to its edge

// The place on a face that is nearest to one beside or over it.
struct PlaceBeside {
  Vec3 at;
  double aside = 0;    // [m] 0 where it is over or under the face
  double outline = 0;  // [m] to the face's outline
};

PlaceBeside place_beside(const Face& face, const Vec3& p) {
  const Vec2 q = face.frame.to_plane(p);
  Vec2 best = q;
  double least = std::numeric_limits<double>::max();
  for (const auto& ring : face.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 at = nearest_on(q, ring[i], ring[(i + 1) % ring.size()]);
      if (const double distance = (at - q).norm(); distance < least) least = distance, best = at;
    }
  if (is_inside(face.rings, q)) return {face.frame.to_space(q), 0, least};
  return {face.frame.to_space(best), least, least};
}

// On an edge of a piece, for so much of it.
struct EdgePlace {
  Vec3 at, outwards;
  double length;  // [m]
};

// What the edges of one piece meet.
struct Borders {
  std::vector<std::size_t> others;  // that are of one floor with it
  double steps = 0, gaps = 0;       // [m], [m2]; those that another's edge sees too by half
};

class FloorSurvey {
 public:
  FloorSurvey(const World& world, const RayScene& scene, const FloorQualityOptions& options)
      : up_(world.frame.up), scene_(scene), options_(options) {
    // Uneven ground is in facets.
    for (Face& face : faces_of(world))
      if (face.area > 0 && face.surface->kind == Kind::floor && !face.surface->ground)
        faces_.push_back(std::move(face));
  }

  FloorQuality run() const {
    std::vector<Borders> borders(faces_.size());
    parallel_for(faces_.size(), [&](std::size_t i) { borders[i] = look_around(i); });
    FloorQuality quality;
    DisjointSets sets(faces_.size());
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      quality.area += faces_[i].area;
      quality.steps += borders[i].steps, quality.gaps += borders[i].gaps;
      for (std::size_t k : borders[i].others) sets.unite(i, k);
    }
    std::map<std::uint32_t, std::vector<double>> areas;
    for (std::size_t i = 0; i < faces_.size(); ++i) areas[sets.find(i)].push_back(faces_[i].area);
    for (auto& [first, pieces] : areas) quality.floors.push_back(whole_of(std::move(pieces)));
    std::stable_sort(quality.floors.begin(), quality.floors.end(),
                     [](const WholeFloor& a, const WholeFloor& b) { return a.area > b.area; });
    return quality;
  }

 private:
  WholeFloor whole_of(std::vector<double> pieces) const {
    std::sort(pieces.begin(), pieces.end(), std::greater());
    WholeFloor floor;
    for (double area : pieces) floor.area += area;
    for (double sum = 0; sum < options_.share * floor.area; ++floor.pieces)
      sum += pieces[floor.pieces];
    return floor;
  }

  Borders look_around(std::size_t i) const {
    Borders borders;
    const Face& face = faces_[i];
    std::vector<std::size_t> near;
    for (std::size_t k = 0; k < faces_.size(); ++k)
      if (k != i && grown(face.box, options_.max_gap).intersects(faces_[k].box)) near.push_back(k);
    if (near.empty()) return borders;
    for (const auto& ring : face.rings)
      for (std::size_t e = 0; e < ring.size(); ++e) {
        const Vec2 a = ring[e], way = ring[(e + 1) % ring.size()] - a;
        const double count = std::ceil(way.norm() / options_.step);
        const Vec2 out = Vec2(way.y(), -way.x()).normalized();
        const Vec3 outwards = face.frame.u * out.x() + face.frame.v * out.y();
        for (double t = 0.5; t < count; ++t)
          look_at(i, near,
                  {face.frame.to_space(a + way * (t / count)), outwards, way.norm() / count},
                  borders);
      }
    std::sort(borders.others.begin(), borders.others.end());
    borders.others.erase(std::unique(borders.others.begin(), borders.others.end()),
                         borders.others.end());
    return borders;
  }

  void look_at(std::size_t i, const std::vector<std::size_t>& near, const EdgePlace& place,
               Borders& borders) const {
    const Vec3& p = place.at;
    double rise = 0;
    PlaceBeside next{p, options_.max_gap};
    std::size_t other = i;
    for (std::size_t k : near) {
      const PlaceBeside b = place_beside(faces_[k], p);
      const double height = std::abs(up_.dot(b.at - p));
      if (height > options_.same_level || b.aside > next.aside) continue;
      if (b.aside == next.aside && other != i && height >= rise) continue;
      next = b, rise = height, other = k;
    }
    if (other == i) return;
    const bool is_apart = next.aside > options_.meet;
    if (is_apart && !is_open(faces_[i], place, next)) return;
    borders.others.push_back(other);
    // The other piece's outline sees this one too, where it is there.
    const double counted =
        next.outline <= next.aside + options_.meet ? place.length / 2 : place.length;
    if (is_apart)
      borders.gaps += counted * next.aside;
    else if (rise >= options_.min_step && rise <= options_.max_step)
      borders.steps += counted;
  }

  // Whether the next piece is across the edge, not over more of this one, and nothing stands there.
  bool is_open(const Face& face, const EdgePlace& from, const PlaceBeside& to) const {
    if ((to.at - from.at).dot(from.outwards) < kAcrossGap * to.aside) return false;
    if (is_inside(face.rings, face.frame.to_plane((from.at + to.at) / 2))) return false;
    const Vec3 over = options_.height * up_;
    return scene_.is_free(from.at + over, to.at + over);
  }

  const Vec3 up_;
  const RayScene& scene_;
  const FloorQualityOptions& options_;
  std::vector<Face> faces_;  // of floors
};

}  // namespace

double FloorQuality::most_pieces() const {
  double most = 0;
  for (const WholeFloor& floor : floors)
    most = std::max(most,
                    std::ceil(static_cast<double>(floor.pieces) / std::max(1.0, floor.area / 100)));
  return most;
}

FloorQuality measure_floors(const World& world, const RayScene& scene,
                            const FloorQualityOptions& options) {
  return FloorSurvey(world, scene, options).run();
}

}  // namespace scanworld
