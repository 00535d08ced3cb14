// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "cover.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

#include "../parallel.h"

namespace scanworld::space {

using surface::Patch;
using surface::Raster;

namespace {

constexpr float kLeastExpected = 0.1F;  // of a cell to have a point; less says nothing

// The raster with so many more cells to all sides.
Raster widened(const Raster& raster, int more) {
  Raster wide{.low = raster.low - raster.cell * more * Vec2::Ones(),
              .cell = raster.cell,
              .width = raster.width + 2 * more,
              .height = raster.height + 2 * more};
  wide.bits.assign(wide.index(0, wide.height), 0);
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x)
      wide.bits[wide.index(x + more, y + more)] = raster.bits[raster.index(x, y)];
  return wide;
}

// The distance from what is supported by ways that are not blocked (Dijkstra 1959).
std::vector<float> distance_around(const Cover& cover, const Raster& blocked) {
  const Raster& raster = cover.supported;
  const auto step = static_cast<float>(raster.cell), slant = step * std::sqrt(2.0F);
  std::vector<float> distance(raster.bits.size(), Cover::kBlocked);
  using Stop = std::tuple<float, int, int>;
  std::priority_queue<Stop, std::vector<Stop>, std::greater<>> ahead;
  const auto is_inside = [&](int x, int y) {
    for (int b = -1; b <= 1; ++b)
      for (int a = -1; a <= 1; ++a)
        if (!raster.is_set(x + a, y + b)) return false;
    return true;
  };
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x)
      if (raster.is_set(x, y)) {
        distance[raster.index(x, y)] = 0;
        if (!is_inside(x, y)) ahead.emplace(0.0F, x, y);
      }
  while (!ahead.empty()) {
    const auto [d, x, y] = ahead.top();
    ahead.pop();
    const std::size_t i = raster.index(x, y);
    if (d > distance[i] || (blocked.bits[i] && !raster.bits[i]) || d > cover.reach) continue;
    for (int b = -1; b <= 1; ++b)
      for (int a = -1; a <= 1; ++a) {
        if (!raster.contains(x + a, y + b)) continue;
        float& there = distance[raster.index(x + a, y + b)];
        const float longer = d + (a != 0 && b != 0 ? slant : step);
        if (longer < there) there = longer, ahead.emplace(longer, x + a, y + b);
      }
  }
  return distance;
}

// Whether a patch is the floor of a room: it looks up, and ceilings are over a part of it. Ground
// under the sky bends, and its planes must not run far.
bool is_room_floor(const Patch& patch, double area, const std::vector<Patch>& patches,
                   const Vec3& up) {
  constexpr double kHeadroom = 1.5, kHighest = 10;  // [m] a ceiling is over a floor
  constexpr double kLeast = 0.25;                   // of the floor that is under ceilings
  if (patch.plane.normal.dot(up) < kLevelCosine) return false;
  double left = kLeast * area;
  for (const Patch& ceiling : patches) {
    if (ceiling.hit.bits.empty() || ceiling.plane.normal.dot(up) > -kLevelCosine) continue;
    const double square = ceiling.covered.cell * ceiling.covered.cell;
    for (std::size_t i = 0; i < ceiling.covered.bits.size(); ++i) {
      if (!ceiling.covered.bits[i]) continue;
      const Vec3 place = ceiling.frame.to_space(ceiling.covered.middle(i));
      const double height = patch.plane.signed_distance(place);
      if (height > kHeadroom && height < kHighest && patch.hit.find(patch.frame.to_plane(place)))
        left -= square;
    }
    if (left < 0) return true;
  }
  return false;
}

Cover cover_of(const Patch& patch, const std::vector<Patch>& patches, const Sight& sight,
               const CoverOptions& options) {
  Cover cover{.plane = patch.plane, .frame = patch.frame};
  if (patch.hit.bits.empty()) return cover;
  const double cell = patch.hit.cell;
  const auto cells = std::count(patch.covered.bits.begin(), patch.covered.bits.end(), 1);
  cover.area = static_cast<double>(cells) * cell * cell;
  const double reach = options.reach_share * std::sqrt(cover.area);
  // Only of a large one it is asked whether it is a floor.
  cover.is_room_floor = reach > std::min(options.max_reach, options.floor_reach) &&
                        is_room_floor(patch, cover.area, patches, sight.up());
  cover.reach = std::clamp(reach, options.min_reach,
                           cover.is_room_floor ? options.floor_reach : options.max_reach);
  const int more = static_cast<int>(std::ceil(cover.reach / cell));
  const Raster& supported = cover.supported = widened(patch.covered, more);
  cover.distance = distance_around(cover, empty_like(supported));
  cover.empty.assign(supported.bits.size(), 0);
  cover.stands_for.assign(supported.bits.size(), 0);
  for (int y = 0; y < patch.hit.height; ++y)
    for (int x = 0; x < patch.hit.width; ++x)
      cover.stands_for[supported.index(x + more, y + more)] =
          std::max(0.0F, patch.evidence[patch.hit.index(x, y)]);
  for (int y = 0; y < supported.height; ++y)
    for (int x = 0; x < supported.width; ++x) {
      const std::size_t i = supported.index(x, y);
      if (supported.bits[i] || cover.distance[i] > cover.reach + cell) continue;
      // Beyond the patch's cells as many points are expected as at their border.
      const int px = std::clamp(x - more, 0, patch.hit.width - 1),
                py = std::clamp(y - more, 0, patch.hit.height - 1);
      const float expected = -patch.evidence[patch.hit.index(px, py)];
      if (expected < kLeastExpected) continue;
      const Vec3 place = patch.frame.to_space(supported.middle(x, y));
      if (sight.is_exposed(place, patch.plane.normal)) cover.empty[i] = std::min(expected, 1.0F);
    }
  return cover;
}

// Whether a surface is likely to stand at a place of it: it has points there or may have, hidden.
bool may_stand_at(const Cover& cover, const Vec3& place) {
  constexpr float kOpen = 0.3F;
  const auto at = cover.supported.find(cover.frame.to_plane(place));
  return at && (cover.supported.bits[*at] ||
                (cover.distance[*at] <= cover.reach && cover.empty[*at] < kOpen));
}

// Sets the cells of a cover along a seam, where the other surface stands.
void block(const Cover& cover, const Cover& other, const surface::Seam& seam, Raster& blocked) {
  constexpr double kAside = 0.1;  // [m] to both sides of the seam, where the other one is looked at
  const double step = cover.supported.cell / 2;
  const Vec3 aside = kAside * cover.plane.normal;
  for (double t = seam.seen.front().low; t <= seam.seen.back().high; t += step) {
    const Vec3 p = seam.line.at(t);
    if (!may_stand_at(other, p + aside) && !may_stand_at(other, p - aside)) continue;
    const Vec2 q = cover.frame.to_plane(p);
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {step, 0.0}, {0.0, step}})
      set(blocked, q + Vec2(x, y));
  }
}

}  // namespace

std::vector<Cover> find_covers(const std::vector<Patch>& patches,
                               const std::vector<surface::Seam>& seams, const Sight& sight,
                               const CoverOptions& options) {
  std::vector<Cover> covers(patches.size());
  parallel_for(patches.size(),
               [&](std::size_t k) { covers[k] = cover_of(patches[k], patches, sight, options); });
  std::vector<std::vector<const surface::Seam*>> seams_of(patches.size());
  for (const surface::Seam& seam : seams)
    for (const int k : {seam.a, seam.b}) seams_of[static_cast<std::size_t>(k)].push_back(&seam);
  std::vector<std::vector<float>> distances(patches.size());
  parallel_for(patches.size(), [&](std::size_t k) {
    if (covers[k].is_none()) return;
    Raster blocked = empty_like(covers[k].supported);
    for (const surface::Seam* seam : seams_of[k]) {
      const int other = seam->a == static_cast<int>(k) ? seam->b : seam->a;
      block(covers[k], covers[static_cast<std::size_t>(other)], *seam, blocked);
    }
    if (std::find(blocked.bits.begin(), blocked.bits.end(), 1) != blocked.bits.end())
      distances[k] = distance_around(covers[k], blocked);
  });
  // Only now, as covers ask each other what may stand at a seam.
  for (std::size_t k = 0; k < covers.size(); ++k)
    if (!distances[k].empty()) covers[k].distance = std::move(distances[k]);
  return covers;
}

}  // namespace scanworld::space
