// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "cut_curves.h"

#include <cmath>

#include "world/assemble.h"
#include "world/round_solids.h"

namespace scanworld {

CutCurves cut_curves(const PointCloud& cloud, const std::vector<Curve>& curves,
                     const surface::FacetOptions& options, std::vector<Plane>& planes,
                     ReconstructResult& result) {
  CutCurves parts{.curves = curves, .curve_of_plane = std::vector<std::int32_t>(planes.size(), -1)};
  for (std::size_t k = 0; k < curves.size(); ++k) {
    parts.first.push_back(planes.size());
    parts.facets.emplace_back();
    if (is_solid(curves[k])) continue;
    const auto& facets = parts.facets.back().emplace(curves[k], options).planes();
    planes.insert(planes.end(), facets.begin(), facets.end());
    parts.curve_of_plane.resize(planes.size(), static_cast<std::int32_t>(k));
    result.report.plane_noise.resize(planes.size(),
                                     std::hypot(curves[k].support.rms, options.sagitta / 3));
  }
  for (std::size_t i = 0; i < result.curve_labels.size(); ++i)
    if (const std::int32_t c = result.curve_labels[i]; c >= 0)
      result.labels[i] = parts.plane_of(c, cloud.points[i].cast<double>());
  return parts;
}

void add_curves(const std::vector<Curve>& curves, World& world) {
  std::vector<double> inwards(curves.size());
  for (const Surface& s : world.surfaces)
    if (s.curve) {
      const auto k = static_cast<std::size_t>(*s.curve);
      const Vec3 out = curves[k].shape.normal_at(centroid(world, s));
      inwards[k] += out.dot(s.plane.normal) < 0 ? area(world, s) : -area(world, s);
    }
  for (std::size_t k = 0; k < curves.size(); ++k) {
    CurvedPart part{static_cast<int>(k), curves[k]};
    if (is_solid(curves[k]))
      world.obstacles.push_back({.shape = solid_of(curves[k], world.frame.up), .curve = part.id});
    else
      part.curve.hollow = inwards[k] > 0;
    world.curves.push_back(std::move(part));
  }
}

}  // namespace scanworld
