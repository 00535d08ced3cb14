// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "seams.h"

#include <cmath>

#include "../parallel.h"

namespace scanworld::surface {

namespace {

// The part of a line in a box.
Interval clip(const Line3& line, const Box3& box) {
  Interval part{-1e9, 1e9};
  const double t0 = line.direction.dot(line.point);
  for (int a = 0; a < 3; ++a) {
    const double d = line.direction[a], p = line.point[a];
    if (std::abs(d) < 1e-9) {
      if (p < box.min()[a] || p > box.max()[a]) return {0, -1};
      continue;
    }
    const double t1 = (box.min()[a] - p) / d, t2 = (box.max()[a] - p) / d;
    part.low = std::max(part.low, t0 + std::min(t1, t2));
    part.high = std::min(part.high, t0 + std::max(t1, t2));
  }
  return part;
}

// Where the line runs near both patches.
std::vector<Interval> find_common(const Line3& line, const Interval& range, const Patch& a,
                                  const Raster& near_a, const Patch& b, const Raster& near_b) {
  const double step = std::min(near_a.cell, near_b.cell);
  std::vector<Interval> found;
  for (double k = std::floor(range.low / step); k * step <= range.high; ++k) {
    const Vec3 p = line.at((k + 0.5) * step);
    if (!near_a.is_set(a.frame.to_plane(p)) || !near_b.is_set(b.frame.to_plane(p))) continue;
    if (!found.empty() && k * step - found.back().high < 1.5 * step)
      found.back().high = (k + 1) * step;
    else
      found.push_back({k * step, (k + 1) * step});
  }
  return found;
}

constexpr double kFoldReach = 0.5;  // [m] from a fold: so far its two facets part
constexpr double kFoldShare = 0.9;  // of their cells there, each on its side

// On which side of a line a patch is where both are near it: -1 or 1, or 0 for either.
int fold_side(const Patch& patch, const Line3& line, const std::vector<Interval>& seen) {
  const Vec2 at = patch.frame.to_plane(line.point),
             way = (patch.frame.to_plane(line.at(line.direction.dot(line.point) + 1)) - at)
                       .normalized();
  const double start = line.direction.dot(line.point);
  double left = 0, right = 0;
  for (int y = 0; y < patch.hit.height; ++y)
    for (int x = 0; x < patch.hit.width; ++x) {
      const std::size_t cell = patch.hit.index(x, y);
      if (!patch.hit.bits[cell]) continue;
      const Vec2 to = patch.middle[cell] - at;
      const double along = start + way.dot(to), aside = way.x() * to.y() - way.y() * to.x();
      if (std::abs(aside) > kFoldReach || along < seen.front().low || along > seen.back().high)
        continue;
      (aside > 0 ? left : right) += 1;
    }
  const double most = kFoldShare * (left + right);
  return left + right == 0 ? 0 : left >= most ? 1 : right >= most ? -1 : 0;
}

// Whether two patches are the facets on either side of a fold.
bool is_fold(const Patch& a, const Patch& b, const Line3& line, const std::vector<Interval>& seen) {
  const int side = fold_side(a, line, seen);
  const bool is_opposed = a.plane.normal.dot(b.plane.normal) < 0;
  return side != 0 && fold_side(b, line, seen) == (is_opposed ? side : -side);
}

}  // namespace

std::vector<Seam> find_seams(const std::vector<Patch>& patches, const SeamOptions& options) {
  std::vector<Raster> near(patches.size()), there(patches.size());
  parallel_for(patches.size(), [&](std::size_t k) {
    const Raster& covered = patches[k].covered;
    if (covered.bits.empty()) return;
    there[k] = grow(covered, 1);
    near[k] = grow(covered, std::max(1, static_cast<int>(options.gap / covered.cell)));
  });
  std::vector<std::vector<Seam>> found(patches.size());
  parallel_for(patches.size(), [&](std::size_t a) {
    if (near[a].bits.empty()) return;
    const Box3 reach = grown(patches[a].box, options.gap);
    for (std::size_t b = a + 1; b < patches.size(); ++b) {
      if (near[b].bits.empty() || !reach.intersects(patches[b].box)) continue;
      const auto line = intersect(patches[a].plane, patches[b].plane, options.fold_sine);
      if (!line) continue;
      const Interval range = clip(*line, reach.intersection(grown(patches[b].box, options.gap)));
      if (range.length() <= 0) continue;
      std::vector<Interval> seen =
          find_common(*line, range, patches[a], near[a], patches[b], near[b]);
      std::erase_if(seen, [&](const Interval& i) { return i.length() < options.min_length; });
      const bool is_gentle = !intersect(patches[a].plane, patches[b].plane, options.min_sine);
      if (!seen.empty() && !(is_gentle && !is_fold(patches[a], patches[b], *line, seen)))
        found[a].push_back({static_cast<int>(a), static_cast<int>(b), *line, std::move(seen),
                            find_common(*line, range, patches[a], there[a], patches[b], there[b])});
    }
  });
  std::vector<Seam> seams;
  for (auto& list : found) seams.insert(seams.end(), list.begin(), list.end());
  return seams;
}

}  // namespace scanworld::surface
