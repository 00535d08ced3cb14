// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "../curve.h"
#include "grid.h"
#include "scale.h"

namespace scanworld::rival {

// How far a site's points are off a round surface: the mean of their distances and the mean of the
// squares of these. Along the surface they spread to both sides of their mean, which therefore lies
// inside of it.
struct OffSurface {
  double mean = 0;    // [m] outwards
  double square = 0;  // [m2]
};
OffSurface off_surface(const Site& site, const RoundShape& shape);

// The round surface nearest to the points of some sites: from the normals of the places around them
// and Taubin's circle (1991), a linear sphere or the apex of their planes, then by least squares of
// the distances, those of outliers counting less. Nothing where the points tell none. `weight`:
// points of a site that count.
std::optional<RoundShape> fit_round(CurveType type, const Grid& grid,
                                    std::span<const std::uint32_t> sites,
                                    std::span<const Vec3f> normals, double weight);

// The same from a shape that is nearly right.
std::optional<RoundShape> refit_round(RoundShape shape, const Grid& grid,
                                      std::span<const std::uint32_t> sites, double weight,
                                      int rounds = 6);

}  // namespace scanworld::rival
