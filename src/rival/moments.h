// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>

#include "../types.h"

namespace scanworld::rival {

// The plane nearest to some points, and how they lie about it.
struct MomentFit {
  Vec3 centroid = Vec3::Zero();
  Plane plane;
  Vec3 variance = Vec3::Zero();  // [m2] eigenvalues of the covariance, ascending; [0] is that off
                                 // the plane
  Vec3 axis = Vec3::UnitX();     // unit vector of the largest spread
};

// Number, sum and sum of products of points: all that is needed to fit a plane to them and to tell
// how far they are from any other. They add up, so points can be moved from plane to plane in
// constant time.
struct Moments {
  double n = 0;
  double x = 0, y = 0, z = 0;
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  Moments& operator+=(const Moments& o) {
    n += o.n, x += o.x, y += o.y, z += o.z;
    xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
    return *this;
  }
  Moments& operator-=(const Moments& o) {
    n -= o.n, x -= o.x, y -= o.y, z -= o.z;
    xx -= o.xx, xy -= o.xy, xz -= o.xz, yy -= o.yy, yz -= o.yz, zz -= o.zz;
    return *this;
  }
  Moments& operator+=(const Vec3& p) {
    n += 1, x += p.x(), y += p.y(), z += p.z();
    xx += p.x() * p.x(), xy += p.x() * p.y(), xz += p.x() * p.z();
    yy += p.y() * p.y(), yz += p.y() * p.z(), zz += p.z() * p.z();
    return *this;
  }

  Vec3 mean() const { return Vec3(x, y, z) / n; }

  Mat3 covariance() const {
    const Vec3 m = mean();
    Mat3 c;
    c << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return c / n - m * m.transpose();
  }

  // Mean of the squared distances from `plane` [m2].
  double mean_square(const Plane& plane) const {
    const Vec3& v = plane.normal;
    const Vec3 m = mean();
    const double off = plane.signed_distance(m);
    const Mat3 c = covariance();
    return std::max(0.0, v.dot(c * v)) + off * off;
  }
};

inline Moments operator+(Moments a, const Moments& b) { return a += b; }

// The plane through the centroid, normal to the direction of least spread (total least squares).
// Needs at least one point.
inline MomentFit fit(const Moments& m) {
  MomentFit result;
  result.centroid = m.mean();
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(m.covariance());
  result.variance = solver.eigenvalues().cwiseMax(0);
  result.plane = plane_through(result.centroid, solver.eigenvectors().col(0));
  result.axis = solver.eigenvectors().col(2);
  return result;
}

}  // namespace scanworld::rival
