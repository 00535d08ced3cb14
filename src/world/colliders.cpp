// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "colliders.h"

#include <algorithm>
#include <numeric>

#include "convex_parts.h"

namespace scanworld {

namespace {

// What is under a facet of ground, straight down: neighbours have their sides in common.
std::vector<Collider> ground_prisms(const Face& face, const Vec3& up, double depth) {
  constexpr double kTolerance = 1e-4;  // [m] of a straight edge
  std::vector<Collider> prisms;
  for (const auto& part : convex_parts(face.rings, kTolerance)) {
    ConvexPrism prism{.base = {}, .extrusion = -depth * up};
    for (const Vec2& p : part) prism.base.push_back(face.frame.to_space(p));
    if (part.size() >= 3) prisms.push_back({face.surface->id, std::move(prism)});
  }
  return prisms;
}

}  // namespace

std::vector<Collider> make_colliders(const World& world, const ColliderOptions& options) {
  const std::vector<Face> faces = faces_of(world);
  const FaceDepths depths = find_depths(faces, options.slabs);
  const Clearance clearance(faces, options.clearance);

  Slabs made;
  made.add(floor_slabs(world, faces, depths, clearance, options.slabs));
  // Large faces first, so that those on the other side of a thing find it covered.
  std::vector<std::size_t> order(faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return faces[a].area > faces[b].area; });
  for (std::size_t i : order) {
    if (faces[i].area <= 0 || faces[i].surface->kind == Kind::floor) continue;
    made.add(slabs_of(faces, depths, i, made, clearance, options.slabs));
  }

  std::vector<Slab>& slabs = made.slabs;
  std::stable_sort(slabs.begin(), slabs.end(),
                   [](const Slab& a, const Slab& b) { return a.surface < b.surface; });
  std::vector<Collider> colliders;
  for (const Slab& slab : slabs)
    colliders.push_back(collider_of(slab, world.surfaces[slab.surface].id));
  for (const Face& face : faces) {
    if (face.area <= 0 || !face.surface->ground) continue;
    const std::vector<Collider> prisms = ground_prisms(face, world.frame.up, options.ground_depth);
    colliders.insert(colliders.end(), prisms.begin(), prisms.end());
  }
  return colliders;
}

OptionList list_options(ColliderOptions& o) {
  return {
      {"colliders.depth", &o.slabs.depth, "m",
       "of a floor, ceiling or wall whose thickness is not known", 0.001},
      {"colliders.other_depth", &o.slabs.other_depth, "m", "of anything else", 0.001},
      {"colliders.max_beside", &o.slabs.max_beside, "m",
       "a thing's side tells its depth if it is no larger, or the face is closed all around", 0},
      {"colliders.max_depth", &o.slabs.max_depth, "m", "of what is known by its sides", 0.001},
      {"colliders.gap", &o.slabs.gap, "m", "neighbours no farther apart touch", 0},
      {"colliders.overlap", &o.slabs.overlap, "m", "of colliders that go on flat", 0},
      {"colliders.min_width", &o.slabs.min_width, "m",
       "narrower strips of a surface get no collider of their own", 0.001},
      {"colliders.ground_depth", &o.ground_depth, "m", "of ground that no plane fits", 0.001},
      {"colliders.least_depth", &o.clearance.least_depth, "m",
       "two faces of a thing that are nearer can't be told from noise", 0.001},
  };
}

}  // namespace scanworld
