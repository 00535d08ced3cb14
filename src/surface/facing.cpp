// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "facing.h"

#include <algorithm>
#include <cmath>

#include "../parallel.h"

namespace scanworld::surface {

namespace {

constexpr double kNear = 0.001;  // [m] a ray's start, off the patch itself

// Over the half space around +z, by the cosine of the angle to it (a Fibonacci spiral).
std::vector<Vec3> directions_over(int count) {
  constexpr double kPi = 3.14159265358979323846;
  const double turn = kPi * (3 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (int k = 0; k < count; ++k) {
    const double r2 = (k + 0.5) / count, r = std::sqrt(r2);
    directions.emplace_back(r * std::cos(k * turn), r * std::sin(k * turn), std::sqrt(1 - r2));
  }
  return directions;
}

// Middles of cells with points, all over the patch.
std::vector<Vec3> places_on(const Patch& patch, int count) {
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < patch.hit.bits.size(); ++i)
    if (patch.hit.bits[i]) cells.push_back(i);
  std::vector<Vec3> places;
  const auto n = std::min(static_cast<std::size_t>(count), cells.size());
  for (std::size_t k = 0; k < n; ++k)
    places.push_back(
        patch.frame.to_space(patch.middle[cells[(2 * k + 1) * cells.size() / (2 * n)]]));
  return places;
}

class Judge {
 public:
  Judge(const PatchRays& rays, const PointCloud& cloud, const FacingOptions& options)
      : rays_(rays),
        cloud_(cloud),
        options_(options),
        directions_(directions_over(options.directions)) {}

  bool is_from_behind(const Patch& patch, std::span<const std::uint32_t> members) const {
    const std::vector<Vec3> places = places_on(patch, options_.places);
    int votes = 0;
    for (const Vec3& place : places)
      for (std::size_t v : find_viewers(rays_, cloud_.viewpoints, place, options_.margin, 1))
        votes += patch.plane.signed_distance(cloud_.viewpoints[v]) > 0 ? 1 : -1;
    if (votes != 0) return votes < 0;
    std::int64_t along = 0;
    if (!cloud_.normals.empty())
      for (std::uint32_t i : members)
        along += cloud_.normals[i].cast<double>().dot(patch.plane.normal) > 0 ? 1 : -1;
    if (along != 0) return along < 0;
    return free_space(patch, places, 1) < free_space(patch, places, -1);
  }

 private:
  // [m] how far one looks from places on a patch to one of its sides, all rays together.
  double free_space(const Patch& patch, const std::vector<Vec3>& places, double side) const {
    double sum = 0;
    for (const Vec3& place : places)
      for (const Vec3& d : directions_) {
        const Vec3 way =
            d.x() * patch.frame.u + d.y() * patch.frame.v + side * d.z() * patch.plane.normal;
        if (const auto hit = rays_.cast(place, way, 1e4, kNear))
          sum += std::min(hit->distance, options_.horizon);
      }
    return sum;
  }

  const PatchRays& rays_;
  const PointCloud& cloud_;
  const FacingOptions& options_;
  const std::vector<Vec3> directions_;
};

// The frame's first axis turns with the normal.
Raster mirrored(const Raster& raster) {
  Raster other = raster;
  other.low.x() = -raster.high().x();
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x)
      other.bits[raster.index(raster.width - 1 - x, y)] = raster.bits[raster.index(x, y)];
  return other;
}

}  // namespace

Patch flipped(const Patch& patch) {
  Patch other = patch;
  other.plane = patch.plane.flipped(), other.frame = frame_of(other.plane);
  other.hit = mirrored(patch.hit), other.covered = mirrored(patch.covered);
  for (int y = 0; y < patch.hit.height; ++y)
    for (int x = 0; x < patch.hit.width; ++x) {
      const std::size_t from = patch.hit.index(x, y),
                        to = patch.hit.index(patch.hit.width - 1 - x, y);
      other.middle[to] = {-patch.middle[from].x(), patch.middle[from].y()};
      other.evidence[to] = patch.evidence[from];
    }
  return other;
}

std::vector<Patch> face_free_side(std::vector<Patch> patches, const PatchRays& rays,
                                  const PointCloud& cloud, const Members& members,
                                  const FacingOptions& options) {
  const Judge judge(rays, cloud, options);
  parallel_for(patches.size(), [&](std::size_t k) {
    if (!patches[k].hit.bits.empty() && judge.is_from_behind(patches[k], members.of(k)))
      patches[k] = flipped(patches[k]);
  });
  return patches;
}

}  // namespace scanworld::surface
