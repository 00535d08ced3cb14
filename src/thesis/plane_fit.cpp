// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "plane_fit.h"

#include <Eigen/Eigenvalues>

namespace scanworld::thesis {

namespace {

template <typename PointAt>
std::optional<PlaneFit> fit(std::size_t count, PointAt point_at) {
  if (count < 3) return std::nullopt;
  Vec3 centroid = Vec3::Zero();
  for (std::size_t i = 0; i < count; ++i) centroid += point_at(i);
  centroid /= static_cast<double>(count);
  Mat3 scatter = Mat3::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 d = point_at(i) - centroid;
    scatter.noalias() += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(scatter);  // eigenvalues ascend
  // On a line the second spread is rounding only, and the normal could be any.
  if (solver.eigenvalues()[1] <= 1e-12 * solver.eigenvalues()[2]) return std::nullopt;
  Vec3 normal = solver.eigenvectors().col(0).normalized();
  int largest = 0;
  normal.cwiseAbs().maxCoeff(&largest);
  if (normal[largest] < 0) normal = -normal;
  return PlaneFit{centroid, plane_through(centroid, normal)};
}

}  // namespace

std::optional<PlaneFit> fit_plane(const std::vector<Vec3>& points) {
  return fit(points.size(), [&](std::size_t i) -> const Vec3& { return points[i]; });
}

std::optional<PlaneFit> fit_plane(const std::vector<Vec3>& points,
                                  const std::vector<int>& indices) {
  return fit(indices.size(), [&](std::size_t i) -> const Vec3& {
    return points[static_cast<std::size_t>(indices[i])];
  });
}

}  // namespace scanworld::thesis
