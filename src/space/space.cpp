// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "space.h"

#include "../parallel.h"

namespace scanworld::space {

namespace {

constexpr double kMargin = 0.05;  // [m] before a place, where its line of sight may meet something
constexpr double kNear = 5;       // [m] viewpoints that are farther from all planes are left out

// For each place around the viewpoint that it was seen from, where any place knows one; else the
// nearest one with a free line to it, or -1.
std::vector<std::int32_t> find_nearest_viewers(const surface::Surroundings& around,
                                               const surface::PatchRays& rays) {
  if (!around.viewers.empty()) return around.viewers;
  std::vector<std::int32_t> viewers(around.points.size(), -1);
  if (around.viewpoints.empty()) return viewers;
  parallel_for(part_count(viewers.size(), kPointsPerPart), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, viewers.size(), kPointsPerPart);
    for (std::size_t i = begin; i < end; ++i) {
      const auto seeing = surface::find_viewers(rays, around.viewpoints,
                                                around.points[i].cast<double>(), kMargin, 1);
      if (!seeing.empty()) viewers[i] = static_cast<std::int32_t>(seeing[0]);
    }
  });
  return viewers;
}

// The box of what planes have points on, and of the viewpoints near it.
Box3 box_of(const std::vector<surface::Patch>& patches, const std::vector<Vec3>& viewpoints) {
  Box3 box;
  for (const surface::Patch& p : patches)
    if (!p.box.isEmpty()) box.extend(p.box);
  if (box.isEmpty()) box.extend(Vec3::Zero());  // no planes: any box, of one cell
  const Box3 near = grown(box, kNear);
  for (const Vec3& v : viewpoints)
    if (near.contains(v)) box.extend(v);
  return box;
}

}  // namespace

Outlook look_out(const std::vector<surface::Patch>& patches, const surface::PatchRays& rays,
                 const std::vector<surface::Seam>& seams, const surface::Surroundings& around,
                 double spacing, double noise, const SpaceOptions& options, const Vec3& up) {
  const std::vector<std::int32_t> viewers = find_nearest_viewers(around, rays);
  Outlook result{.sight = Sight(around, viewers, spacing, options.cover.sight, up)};
  result.covers = find_covers(patches, seams, result.sight, options.cover);
  result.rays = find_rays(around, viewers, result.covers, rays, noise, options.rays);
  result.free = crossed_by(result.rays, result.sight.cell());
  return result;
}

LabelledSpace label_space(const SpaceInput& in, const Outlook& outlook,
                          const std::vector<Vec3>& viewpoints, const SpaceOptions& options) {
  std::vector<SpacePlane> planes = planes_of_space(in, outlook.sight, outlook.free, options.planes);
  Arrangement arrangement = arrange(planes, box_of(in.patches, viewpoints), options.arrange);
  Evidence evidence = find_evidence(arrangement, planes, outlook.covers, outlook.rays, in.up);
  std::vector<Label> labels = label_cells(arrangement.cells, evidence, options.labels);
  labels = fill_slits(arrangement.cells, evidence, std::move(labels), options.labels);
  labels = fill_pockets(arrangement.cells, evidence, std::move(labels), options.labels);
  return {std::move(planes), std::move(arrangement), std::move(evidence), std::move(labels)};
}

}  // namespace scanworld::space
