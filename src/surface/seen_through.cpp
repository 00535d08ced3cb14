// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "seen_through.h"

#include <algorithm>

#include "../parallel.h"

namespace scanworld::surface {

namespace {

// Whether all of a box is on one side of a plane, on which all viewpoints are as well.
bool is_before(const Eigen::AlignedBox3f& box, const Plane& plane,
               const std::vector<Vec3>& viewpoints) {
  const Vec3 center = box.center().cast<double>(), half = box.sizes().cast<double>() / 2;
  const double at = plane.signed_distance(center), reach = half.dot(plane.normal.cwiseAbs());
  if (std::abs(at) <= reach) return false;
  return std::all_of(viewpoints.begin(), viewpoints.end(),
                     [&](const Vec3& v) { return (plane.signed_distance(v) > 0) == (at > 0); });
}

}  // namespace

std::vector<std::int32_t> find_sole_viewers(const Surroundings& around, const PatchRays& rays,
                                            const std::vector<Vec3>& viewpoints,
                                            const SeenThroughOptions& options) {
  const std::size_t count = around.points.size();
  if (viewpoints.empty()) return {};
  if (!around.viewers.empty()) return around.viewers;
  std::vector<std::int32_t> viewers(count, -1);
  const auto most = static_cast<std::size_t>(std::max(1, options.most));
  const std::size_t stride =
      viewpoints.size() == 1 ? 1 : std::max<std::size_t>(1, (count + most - 1) / most);
  parallel_for(part_count(count, kPointsPerPart), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, count, kPointsPerPart);
    for (std::size_t i = (begin + stride - 1) / stride * stride; i < end; i += stride) {
      const std::vector<std::size_t> seeing =
          find_viewers(rays, viewpoints, around.points[i].cast<double>(), options.margin, 2);
      if (seeing.size() == 1) viewers[i] = static_cast<std::int32_t>(seeing[0]);
    }
  });
  return viewers;
}

Raster seen_through(const Patch& patch, const Surroundings& around,
                    const SeenThroughOptions& options) {
  Raster through = empty_like(patch.hit);
  if (around.viewers.empty()) return through;
  std::vector<std::uint8_t> lines(through.bits.size());
  for (std::size_t run = 0; run < around.boxes.size(); ++run) {
    if (is_before(around.boxes[run], patch.plane, around.viewpoints)) continue;
    const std::size_t begin = run * Surroundings::kRun,
                      end = std::min(begin + Surroundings::kRun, around.points.size());
    for (std::size_t i = begin; i < end; ++i) {
      if (around.viewers[i] < 0) continue;
      const Vec3& from = around.viewpoints[static_cast<std::size_t>(around.viewers[i])];
      const Vec3 to = around.points[i].cast<double>();
      const double before = patch.plane.signed_distance(from),
                   behind = patch.plane.signed_distance(to);
      if ((before > 0) == (behind > 0) || std::abs(behind) < options.behind) continue;
      if (std::abs(before - behind) < options.min_cosine * (to - from).norm()) continue;
      const Vec2 q = patch.frame.to_plane(from + (to - from) * (before / (before - behind)));
      if (const auto at = through.find(q))
        lines[*at] = static_cast<std::uint8_t>(std::min(lines[*at] + 1, 255));
    }
  }
  for (int y = 0; y < through.height; ++y)
    for (int x = 0; x < through.width; ++x) {
      if (lines[through.index(x, y)] == 0) continue;
      int sum = 0;
      for (int b = y - 1; b <= y + 1; ++b)
        for (int a = x - 1; a <= x + 1; ++a)
          if (through.contains(a, b)) sum += lines[through.index(a, b)];
      through.bits[through.index(x, y)] = sum >= options.lines;
    }
  return through;
}

}  // namespace scanworld::surface
