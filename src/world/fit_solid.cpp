// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "fit_solid.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "../circle.h"
#include "../error.h"
#include "../polygon.h"
#include "../quantile.h"
#include "convex_parts.h"
#include "solids.h"
#include "support_points.h"

namespace scanworld {

namespace {

constexpr double kLeastTolerance = 0.005;  // [m] however good the scan

double tolerance_of(double noise, const SolidOptions& options) {
  return std::max(options.tolerance * noise, kLeastTolerance);
}

// Points by their place in plan and their height.
struct Upright {
  PlaneFrame frame;
  Vec3 up;
  std::vector<Vec2> plan;
  std::vector<double> height;

  Upright(std::span<const Vec3> points, const Vec3& up_) : frame(frame_of({up_, 0})), up(up_) {
    for (const Vec3& p : points) plan.push_back(frame.to_plane(p)), height.push_back(up.dot(p));
  }
  Vec3 to_space(const Vec2& at, double z) const { return frame.to_space(at) + z * up; }
};

// Where the faces are at both ends of some values: at the median of those that the noise leaves
// around the outermost, but for a few strays.
struct Range {
  double low, high;
};

// A face has many points at its distance; where an edge or a round end is the outermost, few do.
double face_at(const std::vector<double>& values, double end, double width, double range) {
  double face = end;
  for (int round = 0; round < 3; ++round) {
    std::vector<double> near;
    for (double v : values)
      if (std::abs(v - face) <= width) near.push_back(v);
    const double even = 2 * width / std::max(range, width) * static_cast<double>(values.size());
    if (static_cast<double>(near.size()) < std::max(8.0, 1.5 * even)) return end;
    face = quantile(std::move(near), 0.5);
  }
  return face;
}

Range faces_of(const std::vector<double>& values, double noise) {
  const double stray = std::min(0.1, std::max(0.005, 2 / static_cast<double>(values.size())));
  const double low = quantile(values, stray), high = quantile(values, 1 - stray);
  return {face_at(values, low, 3 * noise, high - low),
          face_at(values, high, 3 * noise, high - low)};
}

// The circle through most points: without those farther off than three times the middle one.
std::optional<Circle> fit_circle_robustly(const std::vector<Vec2>& points, double noise) {
  std::vector<WeightedPoint> near;
  for (const Vec2& p : points) near.push_back({p});
  std::optional<Circle> circle = fit_circle(near);
  for (int round = 0; round < 4 && circle; ++round) {
    std::vector<double> off;
    for (const Vec2& p : points) off.push_back(std::abs(circle->signed_distance(p)));
    const double gate = std::max(3 * quantile(off, 0.5), noise);
    near.clear();
    for (std::size_t i = 0; i < points.size(); ++i)
      if (off[i] <= gate) near.push_back({points[i]});
    circle = fit_circle(near);
  }
  return circle;
}

// How far points are off a face, by where on it they are: noise cancels out, another shape does
// not.
class Residuals {
 public:
  explicit Residuals(double noise) : limit_(std::max(noise, kLeastTolerance / 2)) {}

  // `u`, `v`: from 0 to 1 over the face.
  void add(std::size_t face, double u, double v, double off) {
    const auto bin = [](double t) {
      return static_cast<std::size_t>(std::clamp(t, 0.0, 0.999) * kBins);
    };
    Sum& sum = sums_[(face * kBins + bin(u)) * kBins + bin(v)];
    sum.off += off, ++sum.count;
    square_ += off * off, ++count_;
  }
  bool is_noise() const {
    if (square_ > std::pow(kMaxNoise * limit_, 2) * count_) return false;
    return std::all_of(sums_.begin(), sums_.end(), [&](const Sum& sum) {
      return std::abs(sum.off) <= limit_ * (kMaxBias * sum.count + 4 * std::sqrt(sum.count));
    });
  }

 private:
  static constexpr std::size_t kBins = 4, kFaces = 6;
  static constexpr double kMaxNoise = 1.4, kMaxBias = 0.7;
  struct Sum {
    double off = 0, count = 0;
  };
  std::array<Sum, kFaces * kBins * kBins> sums_{};
  double limit_, square_ = 0, count_ = 0;
};

double distance_to(const Range& range, double v) {
  return std::min(std::abs(v - range.low), std::abs(v - range.high));
}
bool is_in(const Range& range, double v, double margin) {
  return v > range.low - margin && v < range.high + margin;
}

// A rectangle in plan at an angle, and how many points lie on the faces of the box over it.
struct PlanRectangle {
  double angle = 0;
  Range x{}, y{};
  std::size_t on = 0;

  Vec2 turned(const Vec2& q) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * q.x() + s * q.y(), c * q.y() - s * q.x()};
  }
};

PlanRectangle rectangle_at(double angle, const Upright& points, const Range& z, double noise,
                           double tolerance) {
  PlanRectangle r{.angle = angle};
  std::vector<double> xs, ys;
  for (const Vec2& q : points.plan) {
    const Vec2 t = r.turned(q);
    xs.push_back(t.x()), ys.push_back(t.y());
  }
  r.x = faces_of(xs, noise), r.y = faces_of(ys, noise);
  for (std::size_t i = 0; i < xs.size(); ++i) {
    if (!is_in(r.x, xs[i], tolerance) || !is_in(r.y, ys[i], tolerance)) continue;
    const double off = std::min(
        {distance_to(r.x, xs[i]), distance_to(r.y, ys[i]), distance_to(z, points.height[i])});
    r.on += off <= tolerance;
  }
  return r;
}

// The rectangle with most points on it, over all angles. What a coarse angle is off, its faces may
// be off too.
std::optional<PlanRectangle> best_rectangle(const Upright& points, const Range& z, double noise,
                                            double tolerance) {
  Eigen::AlignedBox2d box;
  for (const Vec2& q : points.plan) box.extend(q);
  const double radius = box.diagonal().norm() / 2;
  double step = M_PI / 36;
  PlanRectangle best;
  const auto look = [&](double angle) {
    const double slack = radius * step / 2;
    const PlanRectangle r = rectangle_at(angle, points, z, noise + slack / 3, tolerance + slack);
    if (r.on > best.on) best = r;
  };
  for (int k = 0; k < 18; ++k) look(k * step);
  if (3 * best.on < 2 * points.plan.size()) return std::nullopt;
  for (int round = 0; round < 6; ++round) {
    const double middle = best.angle;
    step /= 2, best.on = 0;
    for (int turn : {0, -1, 1}) look(middle + turn * step);
  }
  return rectangle_at(best.angle, points, z, noise, tolerance);
}

// Whether no face is off its points over a part of it.
bool lies_on_faces(const PlanRectangle& r, const Upright& points, const Range& z, double noise,
                   double tolerance) {
  Residuals residuals(noise);
  const std::array<Range, 3> ranges = {r.x, r.y, z};
  for (std::size_t i = 0; i < points.plan.size(); ++i) {
    const Vec2 t = r.turned(points.plan[i]);
    const Vec3 at(t.x(), t.y(), points.height[i]);
    std::size_t face = 0;
    double least = 1e300, off = 0;
    Vec3 share;
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      share[axis] = (at[axis] - ranges[k].low) / std::max(1e-9, ranges[k].high - ranges[k].low);
      for (double out : {ranges[k].low - at[axis], at[axis] - ranges[k].high})
        if (std::abs(out) < least)
          least = std::abs(out), off = out, face = 2 * k + (share[axis] > 0.5);
    }
    if (least > tolerance) continue;
    const int axis = static_cast<int>(face / 2);
    residuals.add(face, share[(axis + 1) % 3], share[(axis + 2) % 3], off);
  }
  return residuals.is_noise();
}

struct Spread {
  Vec3 mean = Vec3::Zero();
  Mat3 squares = Mat3::Zero();  // of all points together
};

Spread spread_of(std::span<const Vec3> points) {
  Spread spread;
  for (const Vec3& p : points) spread.mean += p / static_cast<double>(points.size());
  for (const Vec3& p : points) spread.squares += (p - spread.mean) * (p - spread.mean).transpose();
  return spread;
}

// A box around points in a plane or a line, at least so thick.
OrientedBox flat_box(std::span<const Vec3> points, double thickness) {
  const auto [mean, squares] = spread_of(points);
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(squares);
  Mat3 axes = solver.eigenvectors();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  Box3 box;
  for (const Vec3& p : points) box.extend(axes.transpose() * (p - mean));
  OrientedBox result;
  result.center = mean + axes * box.center();
  result.size = box.sizes().cwiseMax(thickness);
  result.rotation = Eigen::Quaterniond(axes).normalized();
  return result;
}

// Scales points so that they spread alike along all directions, nearly so where they are flat.
Mat3 whitening(std::span<const Vec3> points) {
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(spread_of(points).squares / static_cast<double>(points.size()));
  const Vec3 variance = solver.eigenvalues().cwiseMax(1e-8);
  const Vec3 sigma = variance.cwiseMax(0.01 * variance[2]).cwiseSqrt();
  return solver.eigenvectors() * sigma.cwiseInverse().asDiagonal() *
         solver.eigenvectors().transpose();
}

// Where a thing ends along a direction: the mean of the three outermost points, less the noise that
// made them so.
Vec3 outermost(std::span<const Vec3> points, const Vec3& u, double noise) {
  std::array<std::pair<double, Vec3>, 3> top;
  top.fill({-1e300, points[0]});
  for (const Vec3& p : points) {
    const double h = u.dot(p);
    if (h <= top[2].first) continue;
    top[2] = {h, p};
    for (std::size_t k = 2; k > 0 && top[k].first > top[k - 1].first; --k)
      std::swap(top[k], top[k - 1]);
  }
  return (top[0].second + top[1].second + top[2].second) / 3 - noise * u;
}

}  // namespace

std::optional<Cylinder> fit_cylinder(std::span<const Vec3> points, const Vec3& up, double noise,
                                     const SolidOptions& options) {
  const double tolerance = tolerance_of(noise, options);
  const Upright all(points, up);
  const Range z = faces_of(all.height, noise);
  std::vector<Vec2> side;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (distance_to(z, all.height[i]) > tolerance) side.push_back(all.plan[i]);
  const std::optional<Circle> circle = fit_circle_robustly(side, noise);
  if (!circle) return std::nullopt;
  std::size_t on = 0;
  constexpr int kSectors = 36;
  std::array<int, kSectors> seen{};
  Residuals residuals(noise);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 q = all.plan[i] - circle->center;
    const double off = q.norm() - circle->radius;
    const bool on_end = off < -tolerance && distance_to(z, all.height[i]) <= tolerance;
    const bool on_side = std::abs(off) <= tolerance && is_in(z, all.height[i], tolerance);
    on += on_side || on_end;
    if (!on_side) continue;
    const double turn = (std::atan2(q.y(), q.x()) + M_PI) / (2 * M_PI);
    ++seen[static_cast<std::size_t>(std::min(kSectors - 1.0, turn * kSectors))];
    residuals.add(static_cast<std::size_t>(std::min(3.0, 4 * turn)),
                  4 * turn - std::floor(4 * turn), (all.height[i] - z.low) / (z.high - z.low), off);
  }
  const double arc =
      2 * M_PI / kSectors *
      static_cast<double>(std::count_if(seen.begin(), seen.end(), [](int n) { return n > 1; }));
  if (static_cast<double>(on) < options.min_share * static_cast<double>(points.size()) ||
      arc < options.min_arc || !residuals.is_noise())
    return std::nullopt;
  return Cylinder{all.to_space(circle->center, (z.low + z.high) / 2), circle->radius,
                  z.high - z.low};
}

std::optional<OrientedBox> fit_box(std::span<const Vec3> points, const Vec3& up, double noise,
                                   const SolidOptions& options) {
  const double tolerance = tolerance_of(noise, options);
  const Upright all(points, up);
  const Range z = faces_of(all.height, noise);
  const std::optional<PlanRectangle> best = best_rectangle(all, z, noise, tolerance);
  if (!best ||
      static_cast<double>(best->on) < options.min_share * static_cast<double>(points.size()) ||
      !lies_on_faces(*best, all, z, noise, tolerance))
    return std::nullopt;
  const Vec2 size(best->x.high - best->x.low, best->y.high - best->y.low);
  if (size.x() * size.y() > options.max_empty * std::abs(doubled_area(convex_hull(all.plan))) / 2)
    return std::nullopt;
  const Vec2 middle((best->x.low + best->x.high) / 2, (best->y.low + best->y.high) / 2);
  Mat3 axes;
  axes.col(0) = std::cos(best->angle) * all.frame.u + std::sin(best->angle) * all.frame.v;
  axes.col(1) = std::cos(best->angle) * all.frame.v - std::sin(best->angle) * all.frame.u;
  axes.col(2) = up;
  OrientedBox box;
  box.center = axes * Vec3(middle.x(), middle.y(), (z.low + z.high) / 2);
  box.size = Vec3(size.x(), size.y(), z.high - z.low).cwiseMax(noise);
  box.rotation = Eigen::Quaterniond(axes).normalized();
  return box;
}

Solid enclose(std::span<const Vec3> points, double noise, const SolidOptions& options) {
  const Mat3 white = whitening(points);
  std::vector<Vec3> ways = even_directions(options.max_vertices);
  for (Vec3& u : ways) u = (white * u).normalized();
  ConvexHull hull;
  for (const Vec3& u : ways) hull.vertices.push_back(outermost(points, u, noise));
  double thinnest = 1e300;
  for (const Vec3& u : ways) {
    Range range{1e300, -1e300};
    for (const Vec3& v : hull.vertices)
      range = {std::min(range.low, u.dot(v)), std::max(range.high, u.dot(v))};
    thinnest = std::min(thinnest, range.high - range.low);
  }
  if (thinnest < std::max(noise, kLeastTolerance))
    return flat_box(points, std::max(noise, kLeastTolerance));
  Mesh mesh;
  try {
    mesh = mesh_of(hull);
  } catch (const Error&) {
    return flat_box(points, std::max(noise, kLeastTolerance));
  }
  return ConvexHull{mesh.vertices};
}

std::optional<Solid> fit_simple(std::span<const Vec3> points, const Vec3& up, double noise,
                                const SolidOptions& options) {
  if (const auto cylinder = fit_cylinder(points, up, noise, options)) return *cylinder;
  if (const auto box = fit_box(points, up, noise, options)) return *box;
  return std::nullopt;
}

Solid fit_solid(std::span<const Vec3> points, const Vec3& up, double noise,
                const SolidOptions& options) {
  if (const auto simple = fit_simple(points, up, noise, options)) return *simple;
  return enclose(points, noise, options);
}

}  // namespace scanworld
