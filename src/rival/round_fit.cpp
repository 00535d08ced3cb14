// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "round_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "../circle.h"
#include "../quantile.h"

namespace scanworld::rival {

namespace {

constexpr double kLargestRadius = 100;  // [m] of anything that is called round
constexpr int kMostParameters = 6;      // parameters of a shape
constexpr double kWidest = 1.3;         // [rad] half angle of a cone; a wider one is a disc

using Parameters = Eigen::Matrix<double, kMostParameters, 1>;
using NormalMatrix = Eigen::Matrix<double, kMostParameters, kMostParameters>;

double weight_of(const Site& site, double most) { return std::min<double>(site.points, most); }

Vec3 centroid_of(const Grid& grid, std::span<const std::uint32_t> sites, double weight) {
  Vec3 sum = Vec3::Zero();
  double n = 0;
  for (std::uint32_t i : sites) {
    const double w = weight_of(grid.sites[i], weight);
    n += w, sum += w * grid.sites[i].position();
  }
  return sum / n;
}

std::optional<RoundShape> start_cylinder(const Grid& grid, std::span<const std::uint32_t> sites,
                                         std::span<const Vec3f> normals, double weight) {
  Mat3 spread = Mat3::Zero();
  for (std::size_t k = 0; k < sites.size(); ++k) {
    const Vec3 n = normals[k].cast<double>();
    spread += weight_of(grid.sites[sites[k]], weight) * n * n.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(spread);
  RoundShape shape{.point = centroid_of(grid, sites, weight), .axis = solver.eigenvectors().col(0)};
  const PlaneFrame frame = frame_of({shape.axis, 0});
  std::vector<WeightedPoint> plan;
  for (std::uint32_t i : sites)
    plan.push_back({frame.to_plane(grid.sites[i].position()), weight_of(grid.sites[i], weight)});
  const std::optional<Circle> circle = fit_circle(plan);
  if (!circle) return std::nullopt;
  shape.point = frame.to_space(circle->center) + shape.axis.dot(shape.point) * shape.axis;
  shape.radius = circle->radius;
  return shape;
}

// The least squares of |p|^2 - 2 p.c + k.
std::optional<RoundShape> start_sphere(const Grid& grid, std::span<const std::uint32_t> sites,
                                       double weight) {
  const Vec3 middle = centroid_of(grid, sites, weight);
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  for (std::uint32_t i : sites) {
    const Vec3 p = grid.sites[i].position() - middle;
    const Eigen::Vector4d row(2 * p.x(), 2 * p.y(), 2 * p.z(), 1);
    const double w = weight_of(grid.sites[i], weight);
    a += w * row * row.transpose(), b += w * p.squaredNorm() * row;
  }
  const Eigen::Vector4d x = a.ldlt().solve(b);
  const double square = x[3] + x.head<3>().squaredNorm();
  if (!(square > 0)) return std::nullopt;
  return RoundShape{CurveType::sphere, middle + x.head<3>(), Vec3::UnitZ(), std::sqrt(square)};
}

// Normals on one side of a surface, of which each is one of the two of a plane.
std::vector<Vec3> orient(std::span<const Vec3f> normals) {
  std::vector<Vec3> out;
  Vec3 mean = normals[0].cast<double>();
  for (int round = 0; round < 2; ++round) {
    out.clear();
    Vec3 sum = Vec3::Zero();
    for (const Vec3f& n : normals) {
      out.push_back(n.cast<double>() * (n.cast<double>().dot(mean) < 0 ? -1.0 : 1.0));
      sum += out.back();
    }
    mean = sum;
  }
  return out;
}

// The normals of a cone are those of a circle about its axis, and all its tangent planes go through
// its apex.
std::optional<RoundShape> start_cone(const Grid& grid, std::span<const std::uint32_t> sites,
                                     std::span<const Vec3f> normals, double weight) {
  const std::vector<Vec3> out = orient(normals);
  Moments directions;
  Mat3 a = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  for (std::size_t k = 0; k < sites.size(); ++k) {
    directions += out[k];
    const double w = weight_of(grid.sites[sites[k]], weight);
    a += w * out[k] * out[k].transpose();
    b += w * out[k].dot(grid.sites[sites[k]].position()) * out[k];
  }
  const MomentFit circle = fit(directions);
  RoundShape shape{.type = CurveType::cone, .point = a.ldlt().solve(b)};
  if (!shape.point.allFinite()) return std::nullopt;
  shape.axis = circle.plane.normal;
  const Vec3 middle = centroid_of(grid, sites, weight);
  if (shape.axis.dot(middle - shape.point) < 0) shape.axis = -shape.axis;
  double sine = 0;
  for (const Vec3& n : out) sine += shape.axis.dot(n) / static_cast<double>(out.size());
  shape.half_angle = std::asin(std::min(std::abs(sine), 1.0));
  const double height = shape.axis.dot(middle - shape.point);
  shape.radius = shape.radius_at(height);
  shape.point += height * shape.axis;
  return shape;
}

// How the distance of a point from a shape changes with its parameters: shifts and turns along u
// and v, the radius and the half angle, or shifts along the axes and the radius.
Parameters slopes_of(const RoundShape& shape, const PlaneFrame& frame, const Vec3& p) {
  const Vec3 out = shape.normal_at(p);
  Parameters j = Parameters::Zero();
  if (shape.type == CurveType::sphere) {
    j.head<3>() = -out;
    j[3] = -1;
    return j;
  }
  const Vec3 way = shape.way_to(p);
  const double h = shape.axis.dot(p - shape.point);
  if (shape.type == CurveType::cone) {
    const double cosine = std::cos(shape.half_angle), wide = std::max(way.norm(), 1e-6);
    const double turn = h * cosine + wide * std::sin(shape.half_angle);
    const double u = way.dot(frame.u) / wide, v = way.dot(frame.v) / wide;
    j << -cosine * u, -cosine * v, -turn * u, -turn * v, -cosine, -h / cosine;
    return j;
  }
  const double u = out.dot(frame.u), v = out.dot(frame.v);
  j << -u, -v, -h * u, -h * v, -1, 0;
  return j;
}

void take_step(RoundShape& shape, const PlaneFrame& frame, const Parameters& by) {
  if (shape.type == CurveType::sphere) {
    shape.point += by.head<3>();
    shape.radius += by[3];
    return;
  }
  shape.point += by[0] * frame.u + by[1] * frame.v;
  shape.axis = (shape.axis + by[2] * frame.u + by[3] * frame.v).normalized();
  shape.radius += by[4];
  if (shape.type == CurveType::cone) shape.half_angle += by[5];
}

// The distance beyond which a site is an outlier [m].
double gate_of(const std::vector<double>& off) {
  std::vector<double> size;
  for (double d : off) size.push_back(std::abs(d));
  return std::max(3 * median(std::move(size)), 1e-6);
}

}  // namespace

OffSurface off_surface(const Site& site, const RoundShape& shape) {
  const Vec3 way = shape.way_to(site.position());
  const double distance = std::max(way.norm(), 1e-6);
  const Vec3 out = way / distance;
  if (shape.type == CurveType::cone) {
    const Vec3 normal = shape.normal_at(site.position());
    const double cosine = std::cos(shape.half_angle);
    const double bulge = site.variance(shape.axis.cross(out)) / (2 * distance);
    const double mean = cosine * (distance + bulge - shape.radius_at(site.position()));
    return {mean, site.variance(normal) + mean * mean};
  }
  const double across = site.variance(out);
  double along = 0;
  if (shape.type == CurveType::sphere) {
    const auto& c = site.covariance;
    along = c[0] + c[3] + c[5] - across;
  } else {
    along = site.variance(shape.axis.cross(out));
  }
  const double mean = distance + along / (2 * distance) - shape.radius;
  return {mean, across + mean * mean};
}

std::optional<RoundShape> refit_round(RoundShape shape, const Grid& grid,
                                      std::span<const std::uint32_t> sites, double weight,
                                      int rounds) {
  const int count = shape.type == CurveType::sphere ? 4 : shape.type == CurveType::cone ? 6 : 5;
  if (sites.size() < static_cast<std::size_t>(count) + 1) return std::nullopt;
  if (shape.type != CurveType::sphere) {  // turns are about the middle of the points
    const double height = shape.axis.dot(centroid_of(grid, sites, weight) - shape.point);
    shape.radius = shape.radius_at(height);
    shape.point += height * shape.axis;
  }
  for (int round = 0; round < rounds; ++round) {
    const PlaneFrame frame = frame_of({shape.axis, 0});
    std::vector<double> off;
    for (std::uint32_t i : sites) off.push_back(off_surface(grid.sites[i], shape).mean);
    const double gate = gate_of(off);
    NormalMatrix a = NormalMatrix::Zero();
    Parameters b = Parameters::Zero();
    for (std::size_t k = 0; k < sites.size(); ++k) {
      if (std::abs(off[k]) > gate) continue;
      const double t = off[k] / gate, w = weight_of(grid.sites[sites[k]], weight) * (1 - t * t) *
                                          (1 - t * t);  // Tukey's biweight
      const Parameters j = slopes_of(shape, frame, grid.sites[sites[k]].position());
      a += w * j * j.transpose(), b += w * off[k] * j;
    }
    const Eigen::MatrixXd left = a.topLeftCorner(count, count);
    Parameters step = Parameters::Zero();
    step.head(count) = -left.ldlt().solve(b.head(count));
    if (!step.allFinite()) return std::nullopt;
    take_step(shape, frame, step);
    if (!(shape.radius > 0 && shape.radius < kLargestRadius)) return std::nullopt;
    if (std::abs(shape.half_angle) > kWidest) return std::nullopt;
    if (step.cwiseAbs().maxCoeff() < 1e-6) break;
  }
  if (shape.half_angle < 0) shape.axis = -shape.axis, shape.half_angle = -shape.half_angle;
  return shape;
}

std::optional<RoundShape> fit_round(CurveType type, const Grid& grid,
                                    std::span<const std::uint32_t> sites,
                                    std::span<const Vec3f> normals, double weight) {
  const std::optional<RoundShape> start =
      type == CurveType::sphere ? start_sphere(grid, sites, weight)
      : type == CurveType::cone ? start_cone(grid, sites, normals, weight)
                                : start_cylinder(grid, sites, normals, weight);
  if (!start || start->radius > kLargestRadius) return std::nullopt;
  return refit_round(*start, grid, sites, weight, 3);
}

}  // namespace scanworld::rival
