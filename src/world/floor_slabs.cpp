// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "floor_slabs.h"

#include <algorithm>
#include <cmath>

#include "../polygon.h"
#include "ray_scene.h"

namespace scanworld {

namespace {

constexpr double kAbove = 0.001, kBelow = 0.002;  // [m] of floors that are one, off its plane
constexpr double kRaster = 0.2;                   // [m] between places that are looked down from
constexpr double kMaxCells = 1000;                // of a box, about

// Floors in one plane.
using Group = std::vector<std::size_t>;

std::vector<Group> group_floors(const std::vector<Face>& faces) {
  std::vector<std::size_t> floors;
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (faces[i].area > 0 && faces[i].surface->kind == Kind::floor && !faces[i].surface->ground)
      floors.push_back(i);
  std::stable_sort(floors.begin(), floors.end(),
                   [&](std::size_t a, std::size_t b) { return faces[a].area > faces[b].area; });
  std::vector<Group> groups;
  for (std::size_t i : floors) {
    const auto fits = [&](const Group& group) {
      const Plane& plane = faces[group[0]].surface->plane;
      return std::all_of(faces[i].rings[0].begin(), faces[i].rings[0].end(), [&](const Vec2& p) {
        const double d = plane.signed_distance(faces[i].frame.to_space(p));
        return d >= -kAbove && d <= kBelow;
      });
    };
    const auto group = std::find_if(groups.begin(), groups.end(), fits);
    if (group == groups.end())
      groups.push_back({i});
    else
      group->push_back(i);
  }
  return groups;
}

// Boxes below the floors of one group.
class Joiner {
 public:
  Joiner(const RayScene& scene, const World& world, const std::vector<Face>& faces,
         const Group& group, const Clearance& clearance, double depth)
      : scene_(scene), world_(world), faces_(faces), clearance_(clearance), depth_(depth) {
    lead_ = group[0];
    for (std::size_t i : group) floors_.push_back(seen_in(faces[lead_].frame, faces[i]));
  }

  // The box around these places, if there is nothing free in it.
  std::optional<Slab> join(const Rectangle& around) const {
    const Slab slab = slab_of(lead_, faces_[lead_].frame, around, depth_);
    if (!clearance_.fits(slab)) return std::nullopt;
    const Vec2 size = around.sizes();
    const double step = std::max(kRaster, std::sqrt(size.prod() / kMaxCells));
    const Vec2 count = (size / step).array().ceil();
    for (int i = 0; i < static_cast<int>(count.x()); ++i)
      for (int k = 0; k < static_cast<int>(count.y()); ++k) {
        const Vec2 at =
            around.min() + size.cwiseProduct(Vec2(i + 0.5, k + 0.5).cwiseQuotient(count));
        if (looks_down(slab, at)) return std::nullopt;
      }
    return slab;
  }

  Rectangle around_all() const {
    Rectangle box;
    for (const geos::Rings& rings : floors_)
      for (const Vec2& p : rings[0]) box.extend(p);
    return box;
  }
  Rectangle around(const Slab& slab) const {
    Rectangle box;
    for (const Vec2& p : slab.corners())
      box.extend(faces_[lead_].frame.to_plane(slab.to_space(p, 0)));
    return box;
  }

 private:
  // Whether there is no floor here but the front of something below.
  bool looks_down(const Slab& slab, const Vec2& at) const {
    if (std::any_of(floors_.begin(), floors_.end(),
                    [&](const geos::Rings& rings) { return is_inside(rings, at); }))
      return false;
    const Vec3 down = -slab.normal();
    const auto hit = scene_.cast(slab.to_space(at, 0.001), down);
    return hit && hit->is_surface && world_.surfaces[hit->index].plane.normal.dot(down) < -0.1;
  }

  const RayScene& scene_;
  const World& world_;
  const std::vector<Face>& faces_;
  const Clearance& clearance_;
  const double depth_;
  std::size_t lead_;
  std::vector<geos::Rings> floors_;  // in the frame of the first
};

// Joins slabs two by two for as long as that goes.
void join_all(std::vector<Slab>& slabs, const Joiner& joiner) {
  const auto join = [&](std::size_t a, std::size_t b) {
    const auto both = joiner.join(joiner.around(slabs[a]).merged(joiner.around(slabs[b])));
    if (!both) return false;
    slabs[a] = *both;
    slabs.erase(slabs.begin() + static_cast<std::ptrdiff_t>(b));
    return true;
  };
  for (std::size_t a = 0; a < slabs.size(); ++a)
    for (std::size_t b = a + 1; b < slabs.size();) {
      if (!join(a, b)) {
        ++b;
        continue;
      }
      // One that has grown is tried again with those before it, and with all behind it; no other
      // two have changed.
      for (std::size_t before = 0; before < a;)
        if (join(before, a))
          a = before, before = 0;
        else
          ++before;
      b = a + 1;
    }
}

}  // namespace

std::vector<Slab> floor_slabs(const World& world, const std::vector<Face>& faces,
                              const FaceDepths& depths, const Clearance& clearance,
                              const SlabOptions& options) {
  std::vector<Slab> all;
  const RayScene scene(world);
  for (const Group& group : group_floors(faces)) {
    double depth = options.depth;
    for (std::size_t i : group) depth = std::max(depth, depths.depth[i]);
    const Joiner joiner(scene, world, faces, group, clearance, depth);
    const Rectangle tight = joiner.around_all();
    const Rectangle wide(tight.min().array() - options.depth, tight.max().array() + options.depth);
    auto one = joiner.join(wide);  // under the walls around
    if (!one) one = joiner.join(tight);
    if (one) {
      all.push_back(*one);
      continue;
    }
    std::vector<Slab> boxes;
    for (std::size_t i : group) {
      const auto slabs = slabs_of(faces, depths, i, {}, clearance, options);
      boxes.insert(boxes.end(), slabs.begin(), slabs.end());
    }
    join_all(boxes, joiner);
    all.insert(all.end(), boxes.begin(), boxes.end());
  }
  return all;
}

}  // namespace scanworld
