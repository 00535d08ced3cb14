// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "stray_surfaces.h"

#include <algorithm>
#include <cmath>

#include "../mesh_rays.h"
#include "../parallel.h"
#include "../polygon.h"
#include "faces.h"
#include "solids.h"

namespace scanworld {

namespace {

class StrayFinder {
 public:
  StrayFinder(const World& world, const StrayOptions& options)
      : options_(options), faces_(faces_of(world)) {
    for (const Face& face : faces_) outlines_.push_back(outline_of(face));
    for (const Obstacle& obstacle : world.obstacles) {
      solids_.push_back(mesh_of(obstacle, world.frame));
      boxes_.emplace_back();
      for (const Vec3& v : solids_.back().vertices) boxes_.back().extend(v);
    }
  }

  StraySurfaces run() const {
    std::vector<char> floats(faces_.size());
    std::vector<double> crossings(faces_.size());
    parallel_for(faces_.size(), [&](std::size_t i) {
      floats[i] = faces_[i].area > 0 && !meets_any(i);
      for (std::size_t k = i + 1; k < faces_.size(); ++k) crossings[i] += crossing(i, k);
    });
    // What all else may meet floats as little as the ground does.
    const auto largest = std::max_element(
        faces_.begin(), faces_.end(), [](const Face& a, const Face& b) { return a.area < b.area; });
    if (largest != faces_.end()) floats[static_cast<std::size_t>(largest - faces_.begin())] = 0;
    StraySurfaces found;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      found.area += faces_[i].area;
      found.crossings += crossings[i];
      for (const auto& ring : faces_[i].rings)
        for (std::size_t e = 0; e < ring.size(); ++e)
          found.edges += (ring[(e + 1) % ring.size()] - ring[e]).norm() / 2;
      if (!floats[i]) continue;
      found.floating.push_back(faces_[i].surface->id);
      found.floating_area += faces_[i].area;
    }
    return found;
  }

 private:
  std::vector<Vec3> outline_of(const Face& face) const {
    std::vector<Vec3> places;
    for (const auto& ring : face.rings)
      for (std::size_t e = 0; e < ring.size(); ++e) {
        const Vec2 way = ring[(e + 1) % ring.size()] - ring[e];
        const double count = std::max(1.0, std::ceil(way.norm() / (2 * options_.step)));
        for (double t = 0; t < count; ++t)
          places.push_back(face.frame.to_space(ring[e] + way * (t / count)));
      }
    return places;
  }

  bool comes_near(const std::vector<Vec3>& places, const Face& face) const {
    const Box3 box = grown(face.box, options_.near);
    return std::any_of(places.begin(), places.end(), [&](const Vec3& p) {
      return box.contains(p) && face.is_near(p, options_.near);
    });
  }

  // Whether a surface ends at another one or at an obstacle, or one of these at it.
  bool meets_any(std::size_t i) const {
    const Face& face = faces_[i];
    const Box3 around = grown(face.box, options_.near);
    for (std::size_t k = 0; k < faces_.size(); ++k)
      if (k != i && faces_[k].area > 0 && around.intersects(faces_[k].box) &&
          (comes_near(outlines_[i], faces_[k]) || comes_near(outlines_[k], face)))
        return true;
    for (std::size_t o = 0; o < solids_.size(); ++o) {
      if (!around.intersects(boxes_[o])) continue;
      if (comes_near(solids_[o].vertices, face)) return true;
      const MeshRays skin(solids_[o]);
      for (const Vec3& p : outlines_[i])
        if (contains(solids_[o], p) || skin.nearest(p, options_.near)) return true;
    }
    return false;
  }

  // How long two surfaces go through each other [m].
  double crossing(std::size_t i, std::size_t k) const {
    const Face &a = faces_[i], &b = faces_[k];
    if (!(a.area > 0 && b.area > 0 && a.box.intersects(b.box))) return 0;
    const Vec3 line = a.normal().cross(b.normal());
    if (line.norm() < std::sin(options_.min_angle)) return 0;
    const Vec3 way = line.normalized();
    const Box3 both = a.box.intersection(b.box);
    // The place where both planes go through, nearest to the middle of what they have in common.
    Mat3 rows;
    rows << a.normal().transpose(), b.normal().transpose(), way.transpose();
    const Vec3 middle = both.center();
    const Vec3 at = middle + rows.inverse() * Vec3(-a.surface->plane.signed_distance(middle),
                                                   -b.surface->plane.signed_distance(middle), 0);
    const double half = both.diagonal().norm() / 2;
    const double count = std::ceil(2 * half / options_.step);
    double length = 0;
    for (double t = 0.5; t < count; ++t) {
      const Vec3 p = at + way * (half * (2 * t / count - 1));
      if (is_well_inside(a, p) && is_well_inside(b, p)) length += 2 * half / count;
    }
    return length;
  }

  bool is_well_inside(const Face& face, const Vec3& p) const {
    const Vec2 q = face.frame.to_plane(p);
    return is_inside(face.rings, q) &&
           std::all_of(face.rings.begin(), face.rings.end(), [&](const auto& ring) {
             return distance_to_ring(q, ring) > options_.inside;
           });
  }

  const StrayOptions& options_;
  const std::vector<Face> faces_;
  std::vector<std::vector<Vec3>> outlines_;  // places along them
  std::vector<Mesh> solids_;                 // the obstacles
  std::vector<Box3> boxes_;                  // around them
};

}  // namespace

StraySurfaces find_stray_surfaces(const World& world, const StrayOptions& options) {
  return StrayFinder(world, options).run();
}

}  // namespace scanworld
