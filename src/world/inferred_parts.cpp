// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "inferred_parts.h"

#include <algorithm>
#include <map>

#include "surface_rings.h"

namespace scanworld {

namespace {

constexpr double kLeast = 1e-3;  // [m] narrower leftovers are none

// Finds vertices by their places, and adds those that are not there yet.
class Vertices {
 public:
  explicit Vertices(World& world) : world_(world) {
    for (std::size_t i = 0; i < world.vertices.size(); ++i)
      index_.try_emplace(key_of(world.vertices[i]), static_cast<int>(i));
  }

  Loop add(const std::vector<Vec3>& ring) {
    Loop loop;
    for (const Vec3& v : ring) {
      const auto [found, is_new] =
          index_.try_emplace(key_of(v), static_cast<int>(world_.vertices.size()));
      if (is_new) world_.vertices.push_back(v);
      if (std::find(loop.begin(), loop.end(), found->second) == loop.end())
        loop.push_back(found->second);
    }
    return loop;
  }

 private:
  using Key = std::array<std::int64_t, 3>;
  static Key key_of(const Vec3& v) {
    return {std::llround(v.x() * 1e5), std::llround(v.y() * 1e5), std::llround(v.z() * 1e5)};
  }

  World& world_;
  std::map<Key, int> index_;
};

}  // namespace

bool is_inferred(const Surface& surface, const Vec3& place) {
  if (surface.source == Source::inferred) return true;
  if (surface.inferred.empty()) return false;
  const PlaneFrame frame = frame_of(surface.plane);
  return std::any_of(surface.inferred.begin(), surface.inferred.end(), [&](const auto& part) {
    return is_inside(flat_rings(frame, part), frame.to_plane(place));
  });
}

double inferred_area(const World& world) {
  double sum = 0;
  for (const Surface& s : world.surfaces) {
    if (s.source == Source::inferred) sum += area(world, s);
    const PlaneFrame frame = frame_of(s.plane);
    for (const InferredPart& part : s.inferred)
      for (const auto& ring : flat_rings(frame, part)) sum += doubled_area(ring) / 2;
  }
  return sum;
}

bool cut_inferred(World& world) {
  std::vector<Surface> kept;
  bool is_less = false;
  int next = 0;
  for (const Surface& s : world.surfaces) next = std::max(next, s.id + 1);
  Vertices vertices(world);
  for (const Surface& s : world.surfaces) {
    is_less |= s.source == Source::inferred || !s.inferred.empty();
    if (s.source == Source::inferred) continue;
    if (s.inferred.empty()) {
      kept.push_back(s);
      continue;
    }
    const PlaneFrame frame = rings_frame(world, s);
    std::vector<geos::Rings> parts;
    for (const InferredPart& part : s.inferred) parts.push_back(flat_rings(frame, part));
    bool is_first = true;
    for (const geos::Rings& left : geos::subtract(rings_of(world, s), parts, kLeast)) {
      Surface piece = s;
      piece.inferred.clear(), piece.holes.clear();
      if (!is_first) piece.id = next++;
      piece.outer = vertices.add(placed_ring(frame, left[0]));
      for (std::size_t k = 1; k < left.size(); ++k)
        if (Loop hole = vertices.add(placed_ring(frame, left[k])); hole.size() > 2)
          piece.holes.push_back(std::move(hole));
      if (piece.outer.size() < 3) continue;
      is_first = false;
      kept.push_back(std::move(piece));
    }
  }
  world.surfaces = std::move(kept);
  return is_less;
}

}  // namespace scanworld
