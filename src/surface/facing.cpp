// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "facing.h"

#include <algorithm>
#include <cmath>
#include <map>

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
  Judge(const PatchRays& rays, const PointCloud& cloud, const Vec3& up,
        const FacingOptions& options)
      : rays_(rays),
        cloud_(cloud),
        up_(up),
        options_(options),
        directions_(directions_over(options.directions)) {}

  const std::vector<Vec3>& directions() const { return directions_; }

  // The side that normals tell: more than 0 for the patch's normal's, 0 for none.
  double told_side(const Patch& patch, std::span<const std::uint32_t> members) const {
    if (cloud_.normals.empty()) return 0;
    std::int64_t along = 0;
    for (std::uint32_t i : members) {
      const double cosine = cloud_.normals[i].cast<double>().dot(patch.plane.normal);
      along += cosine > 0 ? 1 : cosine < 0 ? -1 : 0;  // one that was never set is zero
    }
    const double lead = static_cast<double>(along) / static_cast<double>(members.size());
    return std::abs(lead) >= options_.min_lead ? lead : 0;
  }

  // How far one looks to both sides.
  Outlook look(const Patch& patch) const {
    Outlook outlook{.places = places_on(patch, options_.places)};
    for (std::size_t side : {0u, 1u})
      for (const Vec3& place : outlook.places)
        for (const Vec3& d : directions_) {
          const Vec3 way = d.x() * patch.frame.u + d.y() * patch.frame.v +
                           (side == 0 ? d.z() : -d.z()) * patch.plane.normal;
          if (const auto hit = rays_.cast(place, way, 1e4, kNear))
            outlook.way[side] += std::min(hit->distance, options_.horizon);
          else
            outlook.to_sky[side] += way.dot(up_) > 0;
        }
    return outlook;
  }

 private:
  const PatchRays& rays_;
  const PointCloud& cloud_;
  const Vec3& up_;
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

namespace {

// Whether one sees clearly farther to one side than to the other.
bool is_clear(const Outlook& outlook, const FacingOptions& options) {
  const auto [less, more] = std::minmax({outlook.way[0], outlook.way[1]});
  const auto rays = static_cast<double>(outlook.places.size()) * options.directions;
  return more - less > options.min_lead * (more + less) && more > options.min_way * rays;
}

struct Turned {
  std::vector<Patch> patches;
  std::vector<std::uint8_t> is_sure;  // of the side, for each
};

// To the side that normals tell, or else rays, the ground and the sky.
Turned face_by_rays(std::vector<Patch> patches, const PatchRays& rays, const PointCloud& cloud,
                    const Members& members, const Vec3& up, const FacingOptions& options) {
  const Judge judge(rays, cloud, up, options);
  std::vector<Outlook> outlooks(patches.size());
  parallel_for(patches.size(), [&](std::size_t k) {
    if (patches[k].hit.bits.empty()) return;
    const double told = judge.told_side(patches[k], members.of(k));
    if (told < 0) patches[k] = flipped(patches[k]);
    if (told == 0 || !cloud.viewpoints.empty()) outlooks[k] = judge.look(patches[k]);
    outlooks[k].is_told = told != 0;
  });
  const std::vector<std::uint8_t> turned =
      find_turned(patches, outlooks, rays, judge.directions(), up, options.horizon, options.sky);
  std::vector<std::uint8_t> is_sure(patches.size());
  parallel_for(patches.size(), [&](std::size_t k) {
    const bool agrees = !outlooks[k].is_told || outlooks[k].way[0] > outlooks[k].way[1];
    is_sure[k] = agrees && is_clear(outlooks[k], options);
    if (turned[k]) patches[k] = flipped(patches[k]);
  });
  return {std::move(patches), std::move(is_sure)};
}

// How many places on patches have a free line to a viewpoint.
struct Sight {
  int before = 0, behind = 0;  // the patch
};

// What the viewpoints near a patch see of it.
std::map<std::size_t, Sight> sights_of(const Patch& patch, const PatchRays& rays,
                                       const std::vector<Vec3>& viewpoints,
                                       const FacingOptions& options) {
  std::map<std::size_t, Sight> sights;
  for (const Vec3& place : places_on(patch, options.places))
    for (std::size_t v : free_viewers(rays, viewpoints, place, options.margin, viewpoints.size()))
      ++(patch.plane.signed_distance(viewpoints[v]) > 0 ? sights[v].before : sights[v].behind);
  return sights;
}

// How many of a patch's points each viewpoint is known to have seen. One about in its plane tells
// no side.
std::map<std::size_t, Sight> own_sights_of(const Patch& patch, const PointCloud& cloud,
                                           std::span<const std::uint32_t> members,
                                           const FacingOptions& options) {
  std::map<std::size_t, Sight> sights;
  if (cloud.viewers.empty()) return sights;
  std::vector<int> points(cloud.viewpoints.size());
  for (const std::uint32_t i : members)
    if (const std::int32_t v = cloud.viewers[i]; v >= 0) ++points[static_cast<std::size_t>(v)];
  for (std::size_t v = 0; v < points.size(); ++v) {
    const double distance = patch.plane.signed_distance(cloud.viewpoints[v]);
    if (points[v] == 0 || std::abs(distance) < options.margin) continue;
    (distance > 0 ? sights[v].before : sights[v].behind) = points[v];
  }
  return sights;
}

// Notes the viewpoints, but for those that see patches from behind for the most part.
void find_seeing(const Turned& turned, const PatchRays& rays, const PointCloud& cloud,
                 const Members& members, const FacingOptions& options, Faced& faced) {
  std::vector<std::map<std::size_t, Sight>> sights(turned.patches.size());
  parallel_for(turned.patches.size(), [&](std::size_t k) {
    if (!turned.is_sure[k]) return;
    sights[k] = own_sights_of(turned.patches[k], cloud, members.of(k), options);
    if (sights[k].empty())
      sights[k] = sights_of(turned.patches[k], rays, cloud.viewpoints, options);
  });
  std::vector<Sight> sums(cloud.viewpoints.size());
  for (const auto& of_patch : sights)
    for (const auto& [v, sight] : of_patch)
      sums[v].before += sight.before, sums[v].behind += sight.behind;
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const bool is_seeing = sums[v].behind <= options.max_behind * sums[v].before;
    faced.number.push_back(is_seeing ? static_cast<std::int32_t>(faced.viewpoints.size()) : -1);
    if (is_seeing) faced.viewpoints.push_back(cloud.viewpoints[v]);
  }
}

// The side that the points' own viewpoints are on: more than 0 for the patch's normal's, 0 where
// they do not tell.
int own_side(const Patch& patch, const PointCloud& cloud, std::span<const std::uint32_t> members,
             const Faced& faced, const FacingOptions& options) {
  std::int64_t lead = 0;
  for (const auto& [v, sight] : own_sights_of(patch, cloud, members, options))
    if (faced.number[v] >= 0) lead += sight.before - sight.behind;
  const double least = options.min_lead * static_cast<double>(members.size());
  return lead == 0 || std::abs(static_cast<double>(lead)) < least ? 0 : lead > 0 ? 1 : -1;
}

// The side that viewpoints with a free line to the patch are on, as own_side().
int likely_side(const Patch& patch, const PatchRays& rays, const std::vector<Vec3>& viewpoints,
                const FacingOptions& options) {
  int votes = 0;
  for (const Vec3& place : places_on(patch, options.places))
    for (std::size_t v : find_viewers(rays, viewpoints, place, options.margin, 1))
      votes += patch.plane.signed_distance(viewpoints[v]) > 0 ? 1 : -1;
  return votes;
}

}  // namespace

Faced face_free_side(std::vector<Patch> patches, const PatchRays& rays, const PointCloud& cloud,
                     const Members& members, const Vec3& up, const FacingOptions& options) {
  Faced faced;
  Turned turned = face_by_rays(std::move(patches), rays, cloud, members, up, options);
  find_seeing(turned, rays, cloud, members, options, faced);
  faced.patches = std::move(turned.patches);
  parallel_for(faced.patches.size(), [&](std::size_t k) {
    Patch& patch = faced.patches[k];
    int side = own_side(patch, cloud, members.of(k), faced, options);
    if (side == 0) side = likely_side(patch, rays, faced.viewpoints, options);
    if (side < 0) patch = flipped(patch);
  });
  return faced;
}

}  // namespace scanworld::surface
