// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "../types.h"

namespace scanworld::thesis {

struct PlaneFit {
  Vec3 centroid;
  Plane plane;
};

// The plane that is nearest to the points in the sum of squared distances: through their centroid,
// normal to the direction of smallest spread. Nothing where they do not tell a plane: fewer than
// three, or all on a line. Based on: I. Soderkvist, Using SVD for some fitting problems, 2009
// (Algorithm 3 of the thesis). The right singular vectors are found as eigenvectors of the 3x3
// scatter matrix. The normal's sign, which the thesis leaves free, is such that its largest
// component is positive.
std::optional<PlaneFit> fit_plane(const std::vector<Vec3>& points);

// The same of the points with the given indices.
std::optional<PlaneFit> fit_plane(const std::vector<Vec3>& points, const std::vector<int>& indices);

}  // namespace scanworld::thesis
