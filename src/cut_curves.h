// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "curve.h"
#include "reconstruct.h"
#include "surface/facets.h"

namespace scanworld {

// The curves of a scan and the points on them, as planes: facets of those that bound the place.
struct CutCurves {
  std::vector<Curve> curves;
  std::vector<std::optional<surface::Facets>> facets;  // none of solids
  std::vector<std::size_t> first;            // for each curve the plane of its first facet
  std::vector<std::int32_t> curve_of_plane;  // -1 of what is flat

  // The plane of a point on a curve; -1 on a solid.
  std::int32_t plane_of(std::int32_t curve, const Vec3& p) const {
    const auto& cut = facets[static_cast<std::size_t>(curve)];
    return cut ? static_cast<std::int32_t>(first[static_cast<std::size_t>(curve)] + cut->of(p))
               : -1;
  }
};

// Adds the facets to the planes, and labels the points on them.
CutCurves cut_curves(const PointCloud& cloud, const std::vector<Curve>& curves,
                     const surface::FacetOptions& options, std::vector<Plane>& planes,
                     ReconstructResult& result);

// Adds the curves that are facets of surfaces or solids on their own. Which side is free is what
// their facets say.
void add_curves(const std::vector<Curve>& curves, World& world);

}  // namespace scanworld
