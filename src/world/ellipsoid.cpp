// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "ellipsoid.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "support_points.h"

namespace scanworld {

namespace {

using Vec9 = Eigen::Matrix<double, 9, 1>;
using Mat9 = Eigen::Matrix<double, 9, 9>;

// A quadric is |q|^2 = u * terms(q): the first five coefficients are how it differs from a ball.
Vec9 terms_of(const Vec3& q) {
  const double xx = q.x() * q.x(), yy = q.y() * q.y(), zz = q.z() * q.z();
  Vec9 t;
  t << xx + yy - 2 * zz, xx - 2 * yy + zz, q.x() * q.y(), q.x() * q.z(), q.y() * q.z(), q.x(),
      q.y(), q.z(), 1;
  return t;
}

// How much the terms grow along a way.
Vec9 lean_of(const Vec3& q, const Vec3& way) {
  const Vec3 both = 2 * q.cwiseProduct(way);
  Vec9 t;
  t << both.x() + both.y() - 2 * both.z(), both.x() - 2 * both.y() + both.z(),
      q.x() * way.y() + q.y() * way.x(), q.x() * way.z() + q.z() * way.x(),
      q.y() * way.z() + q.z() * way.y(), way.x(), way.y(), way.z(), 0;
  return t;
}

Mat3 matrix_of(const Vec9& u) {
  Mat3 a;
  a << 1 - u[0] - u[1], -u[2] / 2, -u[3] / 2,     //
      -u[2] / 2, 1 - u[0] + 2 * u[1], -u[4] / 2,  //
      -u[3] / 2, -u[4] / 2, 1 + 2 * u[0] - u[1];
  return a;
}

// Only the lower half is summed, and written out: it is most of the work of a fit.
void add_square(Mat9& sum, const Vec9& t, double weight) {
  for (int column = 0; column < 9; ++column) {
    const double factor = weight * t[column];
    for (int row = column; row < 9; ++row) sum(row, column) += factor * t[row];
  }
}

// In the frame of the quadric, whose unit is `scale`.
std::optional<Ellipsoid> ellipsoid_of(const Vec9& u, const Vec3& origin, double scale) {
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(matrix_of(u));
  // The largest eigenvalue is that of the shortest axis.
  const Vec3 lambda = solver.eigenvalues().reverse();
  Mat3 axes = solver.eigenvectors().rowwise().reverse();
  if (!(lambda[2] > 0.01)) return std::nullopt;
  const Vec3 b = axes.transpose() * Vec3(u[5], u[6], u[7]) / 2;
  const Vec3 c = b.cwiseQuotient(lambda);
  const double k = u[8] + c.dot(b);
  if (!(k > 0)) return std::nullopt;
  Ellipsoid e;
  e.center = origin + scale * (axes * c);
  e.radii = scale * (k * lambda.cwiseInverse()).cwiseSqrt();
  e.half_axes = axes * e.radii.asDiagonal();
  e.to_ball = e.radii.cwiseInverse().asDiagonal() * axes.transpose();
  return e;
}

// The corners of a dodecahedron and the middles of its faces: 32 directions that leave little
// between them.
std::vector<Vec3> corners_of_ball(int max_vertices) {
  if (max_vertices < 32) return even_directions(max_vertices);
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3> corners;
  for (double a : {-1.0, 1.0})
    for (double b : {-1.0, 1.0}) {
      for (double c : {-1.0, 1.0}) corners.emplace_back(a, b, c);
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 narrow = Vec3::Zero(), wide = Vec3::Zero();
        narrow[axis] = a / g, narrow[(axis + 1) % 3] = b * g;
        wide[axis] = a * g, wide[(axis + 1) % 3] = b;
        corners.push_back(narrow), corners.push_back(wide);
      }
    }
  for (Vec3& v : corners) v.normalize();
  return corners;
}

}  // namespace

std::optional<Ellipsoid> fit_ellipsoid(std::span<const Vec3> points, double stiffness,
                                       bool is_final) {
  if (points.size() < 12) return std::nullopt;
  const auto count = static_cast<double>(points.size());
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p / count;
  double spread = 0;
  for (const Vec3& p : points) spread += (p - mean).squaredNorm() / count;
  const double scale = std::sqrt(spread);
  if (!(scale > 1e-6)) return std::nullopt;

  Vec9 u = Vec9::Zero();
  for (int round = 0; round < (is_final ? 4 : 3); ++round) {
    const Mat3 a = matrix_of(u);
    const Vec3 b(u[5], u[6], u[7]);
    Mat9 normal = Mat9::Zero();
    Vec9 right = Vec9::Zero();
    for (const Vec3& p : points) {
      const Vec3 q = (p - mean) / scale;
      Vec9 t = terms_of(q);
      double aim = q.squaredNorm();
      if (round > 0) {
        const Vec3 slope = 2 * (a * q) - b;
        const double steep = std::max(0.2, slope.norm()), off = (aim - u.dot(t)) / steep;
        if (is_final) {
          t = (t - off * lean_of(q, slope / steep)) / steep;
          aim = off + t.dot(u);
        } else {
          t /= steep, aim /= steep;
        }
      }
      add_square(normal, t, 1);
      right += aim * t;
    }
    for (int k = 0; k < 5; ++k) normal(k, k) += std::pow(stiffness / scale, 2);
    u = normal.selfadjointView<Eigen::Lower>().ldlt().solve(right);
    if (!u.allFinite()) return std::nullopt;
  }
  return ellipsoid_of(u, mean, scale);
}

double uncertainty_of(const Ellipsoid& ellipsoid, std::span<const Vec3> points, double noise) {
  // In its own frame it is the unit ball, and the slope there twice the inverse of what a radius
  // shrinks to.
  const auto slope = [&](const Vec3& q) { return 2 * (ellipsoid.to_ball.transpose() * q).norm(); };
  Mat9 normal = 1e-9 * Mat9::Identity();
  for (const Vec3& p : points) {
    const Vec3 q = ellipsoid.to_ball * (p - ellipsoid.center);
    add_square(normal, terms_of(q), 1 / std::pow(slope(q), 2));
  }
  const auto solver = normal.selfadjointView<Eigen::Lower>().ldlt();
  double most = 0;
  for (const Vec3& q : even_directions(24)) {
    const Vec9 t = terms_of(q);
    most = std::max(most, t.dot(solver.solve(t)) / std::pow(slope(q), 2));
  }
  return noise * std::sqrt(most);
}

std::vector<Vec3> corners_of(const Ellipsoid& ellipsoid, int max_vertices) {
  // Between its corners a hull of 32 is 8 % inside the ball.
  constexpr double kOut = 1.03;
  std::vector<Vec3> corners;
  for (const Vec3& q : corners_of_ball(max_vertices))
    corners.push_back(ellipsoid.center + kOut * (ellipsoid.half_axes * q));
  return corners;
}

}  // namespace scanworld
