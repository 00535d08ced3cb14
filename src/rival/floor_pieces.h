// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "../polygon.h"
#include "cluster.h"

namespace scanworld::rival {

// How a level surface lies to a larger one.
struct Encounter {
  double inside = 0, shared = 0;  // squares inside of the lesser one, and where the larger is too
  double offset = 0;              // [m] in those that both have, the median
  double beside = 0;              // squares of the one that are near some of the other alone
  double step = 0, error = 0;     // [m] from the larger to the lesser, and its standard error
  double between = 0;             // [m] from the larger's plane to the lesser's there, the mean
  std::vector<Vec3> contacts;     // half-way between the two, where they are nearest

  bool is_meeting() const { return !contacts.empty(); }
};

// The height of plane `a` over plane `b` at a place [m].
double height_over(const Plane& a, const Plane& b, const Vec3& p, const Vec3& up);

// The level surfaces of a scan that stand on no other: floors, ceilings, treads.
class FloorPieces {
 public:
  // Those tilted by no more than `max_tilt` [rad], and what is no higher than `max_height` [m] over
  // a larger one is a thing on it.
  FloorPieces(const Grid& grid, const Clustering& clustering, const Vec3& up, double max_tilt,
              double max_height);

  // The clusters, those of most points first.
  const std::vector<std::size_t>& clusters() const { return level_; }
  const std::vector<std::uint32_t>& members(std::size_t k) const { return members_[k]; }
  const Box3& box(std::size_t k) const { return boxes_[k]; }
  // Whether two are nearly parallel and no farther apart than this [m].
  bool are_near(std::size_t a, std::size_t b, double reach) const;
  Encounter compare(std::size_t larger, std::size_t lesser, double reach) const;

 private:
  // What is in a square of the plan.
  struct Place {
    double points = 0;
    Vec3 sum = Vec3::Zero();
    Vec3 middle() const { return sum / points; }
  };
  using Square = std::pair<int, int>;
  using Plan = std::map<Square, Place>;

  static bool is_inside(const Plan& plan, const Square& square);
  bool stands_on_another(std::size_t k, double max_height) const;
  Plan plan_of(std::size_t k, const Box3& where, double edge) const;
  double height_between(std::size_t a, const Vec3& at, std::size_t b, const Vec3& from) const;

  const Grid& grid_;
  const Clustering& c_;
  const Vec3 up_;
  const PlaneFrame plan_;
  std::vector<std::vector<std::uint32_t>> members_;
  std::vector<Box3> boxes_;
  std::vector<std::size_t> level_;
};

}  // namespace scanworld::rival
