// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "spots.h"

#include <fmt/format.h>

#include <array>
#include <functional>
#include <map>
#include <memory>

#include "error.h"
#include "mesh_rays.h"
#include "random.h"
#include "sampler.h"
#include "timing.h"
#include "world/solids.h"

namespace scanworld::sim {

namespace {

constexpr double kLevel = 0.95;       // of a normal's height, from where it counts as upright
constexpr double kLevelBin = 0.1;     // [m]
constexpr double kFloorShare = 0.25;  // of the level with most area that a floor has at least

// The middle and the corners of a robot, seen from above.
std::array<Vec3, 5> footprint(double size) {
  const double half = size / 2;
  return {Vec3(0, 0, 0), Vec3(-half, -half, 0), Vec3(half, -half, 0), Vec3(-half, half, 0),
          Vec3(half, half, 0)};
}

// The height of the floor that a robot stands on at a spot.
double floor_under(const MeshRays& mesh, const Vec3& spot, double size) {
  constexpr double kAbove = 0.15;  // [m]
  double depth = 2 * kAbove;
  for (const Vec3& foot : footprint(size))
    if (const auto hit = mesh.cast(spot + foot + Vec3(0, 0, kAbove), -Vec3::UnitZ(), depth))
      depth = std::min(depth, hit->distance);
  return depth < 2 * kAbove ? spot.z() + kAbove - depth : spot.z();
}

// Only worlds are known to turn their triangles' fronts to where one can be.
bool is_oriented(const Place& place) { return place.sort == Sort::world || place.world; }

// Of the triangles that robots could stand on: upright, with their fronts up where that is known.
Sampler level_sampler(const Place& place) {
  return {place.seen, [&place](std::size_t i) {
            const Vec3 normal = vector_area(place.seen, i);
            const double height = is_oriented(place) ? normal.z() : std::abs(normal.z());
            return height >= kLevel * normal.norm();
          }};
}

// The height that floor begins at, in bins: a ceiling has as much area, and is higher.
double main_level(const Sampler& sampler, std::uint64_t seed) {
  Random random(seed);
  std::map<int, int> bins;
  for (int i = 0; i < 4000; ++i)
    ++bins[static_cast<int>(std::floor(sampler.draw(random).point.z() / kLevelBin))];
  int most = 0;
  for (const auto& [bin, count] : bins) most = std::max(most, count);
  for (const auto& [bin, count] : bins)
    if (count >= kFloorShare * most) return (bin + 0.5) * kLevelBin;
  return 0;
}

// The places' surfaces, to ask where there is room.
class Rooms {
 public:
  Rooms(const std::vector<const Place*>& places, const SpotOptions& options) : options_(options) {
    for (const Place* place : places) {
      if (place->seen.triangles.empty()) continue;
      meshes_.push_back(std::make_unique<MeshRays>(place->seen));
      oriented_.push_back(is_oriented(*place) ? &place->seen : nullptr);
    }
  }

  // Whether a robot can be put there, in all places.
  bool has_room(const Vec3& p) const { return can_stand(p) && is_outside(p) && is_clear(p); }

  // Whether in all places there is floor at p.
  bool has_floor(const Vec3& p) const {
    const double above = 0.15;
    return std::ranges::all_of(meshes_, [&](const auto& mesh) {
      const auto hit = mesh->cast(p + Vec3(0, 0, above), -Vec3::UnitZ());
      return hit && std::abs(hit->distance - above) <= options_.tolerance;
    });
  }

  // Whether the whole of a robot stands on it.
  bool can_stand(const Vec3& p) const {
    return std::ranges::all_of(footprint(options_.size),
                               [&](const Vec3& foot) { return has_floor(p + foot); });
  }

  // Whether p, a point of the floor, is in none of the solids that stand on it.
  bool is_outside(const Vec3& p) const {
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      if (!oriented_[i]) continue;
      const auto hit = meshes_[i]->cast(p + Vec3(0, 0, 0.02), Vec3::UnitZ());
      if (hit && vector_area(*oriented_[i], hit->triangle).z() > 0) return false;
    }
    return true;
  }

  // Whether a robot has room at p, a point of the floor, in all places.
  bool is_clear(const Vec3& p) const {
    return std::ranges::all_of(meshes_, [&](const auto& mesh) {
      if (!mesh->is_free(p + Vec3(0, 0, options_.tolerance + 0.01), Vec3::UnitZ(), 0.5))
        return false;
      const int directions = 16;
      for (double height : {0.05, 0.12, 0.25})
        for (int i = 0; i < directions; ++i) {
          const double a = 2 * M_PI * i / directions;
          if (!mesh->is_free(p + Vec3(0, 0, height), {std::cos(a), std::sin(a), 0},
                             options_.clearance))
            return false;
        }
      return true;
    });
  }

 private:
  SpotOptions options_;
  std::vector<std::unique_ptr<MeshRays>> meshes_;
  std::vector<const Mesh*> oriented_;
};

// Keeps points some distance apart, seen from above.
class Apart {
 public:
  explicit Apart(double distance) : distance_(distance) {}
  bool add(const Vec3& p) {
    const int x = static_cast<int>(std::floor(p.x() / distance_)),
              y = static_cast<int>(std::floor(p.y() / distance_));
    for (int i = x - 1; i <= x + 1; ++i)
      for (int j = y - 1; j <= y + 1; ++j)
        if (const auto found = cells_.find({i, j}); found != cells_.end())
          for (const Vec3& q : found->second)
            if ((q - p).head<2>().norm() < distance_) return false;
    cells_[{x, y}].push_back(p);
    return true;
  }

 private:
  double distance_;
  std::map<std::pair<int, int>, std::vector<Vec3>> cells_;
};

// What all spots must be clear in: worlds, or where there are none the first place.
std::vector<const Place*> worlds_of(const std::vector<Place>& places) {
  std::vector<const Place*> worlds;
  for (const Place& place : places)
    if (place.sort == Sort::world) worlds.push_back(&place);
  if (worlds.empty()) worlds.push_back(&reference_of(places));
  return worlds;
}

std::vector<const Place*> others_than_worlds(const std::vector<Place>& places) {
  const std::vector<const Place*> worlds = worlds_of(places);
  std::vector<const Place*> others;
  for (const Place& place : places)
    if (std::ranges::count(worlds, &place) == 0) others.push_back(&place);
  return others;
}

std::optional<Lane> lane_from(const Vec3& from, double length, Random& random,
                              const std::function<bool(const Vec3&)>& is_clear) {
  constexpr double kStride = 0.05;  // [m]
  for (int attempt = 0; attempt < 8; ++attempt) {
    const Vec3 along = random.level_direction();
    bool clear = true;
    for (double at = 0; clear && at <= length; at += kStride) clear = is_clear(from + at * along);
    if (clear) return Lane{from, from + length * along};
  }
  return std::nullopt;
}

}  // namespace

const Place& reference_of(const std::vector<Place>& places) {
  const auto world = std::ranges::find(places, Sort::world, &Place::sort);
  return world == places.end() ? places.front() : *world;
}

Spots find_spots(const std::vector<Place>& places, const SpotOptions& options) {
  const Place& reference = reference_of(places);
  const Sampler level = level_sampler(reference);
  if (level.empty())
    throw Error(Cause::nothing_found,
                reference.name + ": nothing level that robots could stand on");
  const Rooms worlds(worlds_of(places), options), others(others_than_worlds(places), options);
  Spots spots{.height = main_level(level, options.seed)};
  Apart apart(1.5 * options.size);
  Random random(options.seed);
  const std::size_t most = 2000 + 200 * options.count;
  std::vector<Vec3> unshared;
  while (spots.floor.size() < options.count && spots.tried++ < most) {
    const Vec3 p = level.draw(random).point;
    if (std::abs(p.z() - spots.height) > 0.2 || !worlds.has_room(p) || !apart.add(p)) continue;
    (others.has_room(p) ? spots.floor : unshared).push_back(p);
  }
  spots.shared = spots.floor.size();
  unshared.resize(std::min(unshared.size(), options.count - spots.shared));
  spots.floor.insert(spots.floor.end(), unshared.begin(), unshared.end());
  if (spots.floor.empty())
    throw Error(Cause::nothing_found,
                fmt::format("{}: no place for a robot of {} m on the floor at height {:.2f} m",
                            reference.name, options.size, spots.height));
  std::vector<double> heights;
  for (const Vec3& p : spots.floor) heights.push_back(p.z());
  spots.height = quantile_of(heights, 0.5);
  return spots;
}

std::vector<Vec3> touching(const std::vector<Place>& places, const std::vector<Vec3>& spots,
                           double size) {
  constexpr double kInto = 0.001;  // [m]
  const Place& reference = reference_of(places);
  std::vector<Vec3> lowest = spots;
  for (const Place& place : places) {
    if (&place != &reference && place.sort != Sort::world) continue;
    const MeshRays mesh(place.seen);
    for (std::size_t i = 0; i < spots.size(); ++i)
      lowest[i].z() = std::min(lowest[i].z(), floor_under(mesh, spots[i], size) - kInto);
  }
  return lowest;
}

std::vector<Lane> find_lanes(const std::vector<Place>& places, const Spots& spots, double length,
                             std::size_t count, const SpotOptions& options) {
  const Rooms worlds(worlds_of(places), options), others(others_than_worlds(places), options);
  for (const bool in_all : {true, false}) {
    const auto is_clear = [&](const Vec3& p) {
      return worlds.has_floor(p) && worlds.is_clear(p) &&
             (!in_all || (others.has_floor(p) && others.is_clear(p)));
    };
    Random random(options.seed + 1);
    std::vector<Lane> lanes;
    for (std::size_t i = 0; i < spots.floor.size() && lanes.size() < count; ++i)
      if (const auto lane = lane_from(spots.floor[i], length, random, is_clear))
        lanes.push_back(*lane);
    if (!lanes.empty()) return lanes;
  }
  return {};
}

std::vector<Vec3> find_probes(const std::vector<Place>& places, std::size_t count, double off,
                              std::uint64_t seed) {
  const Place& reference = reference_of(places);
  const Sampler anywhere(reference.seen, [](std::size_t) { return true; });
  Random random(seed + 2);
  std::vector<Vec3> probes;
  while (probes.size() < count) {
    const auto [p, triangle] = anywhere.draw(random);
    probes.push_back(p + off * vector_area(reference.seen, triangle).normalized());
  }
  return probes;
}

}  // namespace scanworld::sim
