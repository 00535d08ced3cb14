// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "find_up.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace scanworld {

namespace {

constexpr std::size_t kMostCandidates = 24;  // planes whose pairs are tried
constexpr double kMinWallSine = 0.2;         // between walls that tell an up together
constexpr double kSmooth = 0.0005;   // [rad] angles below this count as squares: noise, no outliers
constexpr double kAxisShare = 0.02;  // of the weight, that the axis speaks with: so little that
                                     // it matters only where nothing else tells
constexpr double kPartial = 0.02;    // share of what is known across that is nothing

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// How far a plane is off level or upright, whichever is less [rad].
struct Slope {
  double angle;
  bool is_level;
};

Slope slope_of(const Vec3& normal, const Vec3& up) {
  const double off_level = std::atan2(normal.cross(up).norm(), std::abs(normal.dot(up)));
  const double off_upright = M_PI / 2 - off_level;
  return off_level < off_upright ? Slope{off_level, true} : Slope{off_upright, false};
}

// The share of the weight that is level or upright to an up.
double share_of(const std::vector<Facing>& facings, const Vec3& up, double tolerance) {
  double all = 0, agreed = 0;
  for (const Facing& f : facings) {
    all += f.weight;
    if (slope_of(f.normal, up).angle < tolerance) agreed += f.weight;
  }
  return all > 0 ? agreed / all : 0;
}

class UpFinder {
 public:
  UpFinder(const std::vector<Facing>& facings, const Vec3& axis, const UpOptions& options,
           double tolerance)
      : facings_(facings), axis_(axis), options_(options), tolerance_(tolerance) {
    for (const Facing& f : facings) total_weight_ += f.weight;
  }

  Up find() const {
    Up up{.direction = axis_, .tolerance = tolerance_};
    if (!(total_weight_ > 0)) return up;
    double most = 0;
    for (const Vec3& candidate : candidates())
      if (const double score = score_of(candidate); score > most)
        most = score, up.direction = candidate;
    up.direction = refine(up.direction);
    up.share = share_of(facings_, up.direction, tolerance_);
    up.is_found = up.share >= options_.min_share;
    up.is_partial = is_partial(up.direction);
    up.angle = angle_between(up.direction, axis_);
    if (up.angle < options_.min_angle) up.direction = axis_;
    return up;
  }

 private:
  // The axis, the normals near it, and what the heaviest walls are along.
  std::vector<Vec3> candidates() const {
    std::vector<std::size_t> order(facings_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return facings_[a].weight > facings_[b].weight;
    });
    std::vector<Vec3> found = {axis_}, walls;
    const auto add = [&](Vec3 up) {
      if (up.dot(axis_) < 0) up = -up;
      if (up.dot(axis_) > std::cos(options_.max_angle)) found.push_back(up);
    };
    for (std::size_t i = 0; i < order.size() && i < 4 * kMostCandidates; ++i) {
      const Vec3& n = facings_[order[i]].normal;
      add(n);
      if (std::abs(n.dot(axis_)) > std::sin(options_.max_angle)) continue;
      add((axis_ - axis_.dot(n) * n).normalized());
      for (const Vec3& other : walls)
        if (const Vec3 along = n.cross(other); along.norm() > kMinWallSine) add(along.normalized());
      if (walls.size() < kMostCandidates) walls.push_back(n);
    }
    return found;
  }

  bool speaks_for(const Facing& f, const Vec3& up) const {
    return slope_of(f.normal, up).angle < tolerance_;
  }

  double score_of(const Vec3& up) const {
    double sum = 0;
    for (const Facing& f : facings_) {
      const double off = slope_of(f.normal, up).angle / tolerance_;
      if (off < 1) sum += f.weight * (1 - off * off);
    }
    return sum / (1 + options_.axis_bonus * angle_between(up, axis_) / options_.max_angle);
  }

  // The least sum of weighted angles, by least squares that are weighted anew.
  Vec3 refine(Vec3 up) const {
    for (int round = 0; round < 50; ++round) {
      const PlaneFrame tangent = frame_of({up, 0});
      const auto flat = [&](const Vec3& v) { return Vec2(v.dot(tangent.u), v.dot(tangent.v)); };
      const double axis_weight =
          kAxisShare * total_weight_ / std::max(angle_between(up, axis_), kSmooth);
      Eigen::Matrix2d known = axis_weight * Eigen::Matrix2d::Identity();
      Vec2 pull = axis_weight * flat(axis_) / axis_.dot(up);
      for (const Facing& f : facings_) {
        const Slope slope = slope_of(f.normal, up);
        if (slope.angle >= tolerance_) continue;
        const double weight = f.weight / std::max(slope.angle, kSmooth);
        const double rise = f.normal.dot(up);
        const Vec2 n = flat(f.normal);
        if (slope.is_level) {
          known += weight * Eigen::Matrix2d::Identity();
          pull += weight * n / rise;
        } else {
          known += weight * n * n.transpose();
          pull -= weight * rise * n;
        }
      }
      const Vec2 step = known.inverse() * pull;
      up = (up + step.x() * tangent.u + step.y() * tangent.v).normalized();
      if (step.norm() < 1e-12) break;
    }
    return up;
  }

  bool is_partial(const Vec3& up) const {
    const PlaneFrame tangent = frame_of({up, 0});
    Eigen::Matrix2d known = Eigen::Matrix2d::Zero();
    for (const Facing& f : facings_) {
      if (!speaks_for(f, up)) continue;
      const Vec2 n(f.normal.dot(tangent.u), f.normal.dot(tangent.v));
      known += f.weight * (slope_of(f.normal, up).is_level ? Eigen::Matrix2d::Identity()
                                                           : Eigen::Matrix2d(n * n.transpose()));
    }
    const Vec2 values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(known).eigenvalues();
    return values[0] < kPartial * values[1];
  }

  const std::vector<Facing>& facings_;
  const Vec3& axis_;
  const UpOptions& options_;
  const double tolerance_;
  double total_weight_ = 0;
};

// The normal of the floor: of the level planes in the lower half the largest.
std::optional<Vec3> floor_of(const std::vector<Facing>& facings, const Vec3& up, double tolerance) {
  constexpr double kLarge =
      0.1;  // of the weight of the largest level plane, to count for the halves
  std::vector<Facing> level;
  for (const Facing& f : facings)
    if (const Slope slope = slope_of(f.normal, up);
        f.weight > 0 && slope.is_level && slope.angle < tolerance)
      level.push_back({f.normal.dot(up) > 0 ? f.normal : Vec3(-f.normal), f.weight, f.middle});
  if (level.empty()) return std::nullopt;
  const double most = std::ranges::max(level, {}, &Facing::weight).weight;
  std::erase_if(level, [&](const Facing& f) { return f.weight < kLarge * most; });
  const auto height = [&](const Facing& f) { return f.middle.dot(up); };
  const auto [low, high] = std::ranges::minmax(level, {}, height);
  const double half = (height(low) + height(high)) / 2;
  std::erase_if(level, [&](const Facing& f) { return height(f) > half; });
  return std::ranges::max(level, {}, &Facing::weight).normal;
}

}  // namespace

Up find_up(const std::vector<Facing>& facings, const Vec3& axis, const UpOptions& options) {
  Up up;
  for (int step = 1; !up.is_found && step * options.tolerance <= options.max_tolerance; ++step)
    up = UpFinder(facings, axis, options, step * options.tolerance).find();
  if (!up.is_found || up.angle <= options.max_unlevelled) return up;
  constexpr int kMostRounds = 3;  // the floor may be near to a ceiling that is near to up
  for (int round = 0; round < kMostRounds; ++round)
    if (const auto floor = floor_of(facings, up.direction, options.max_tolerance))
      up.direction = *floor, up.is_floors = true;
  up.angle = angle_between(up.direction, axis);
  if (up.is_floors) up.share = share_of(facings, up.direction, up.tolerance);
  return up;
}

}  // namespace scanworld
