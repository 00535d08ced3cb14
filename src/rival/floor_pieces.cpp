// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "floor_pieces.h"

#include <algorithm>
#include <cmath>

#include "../quantile.h"

namespace scanworld::rival {

namespace {

constexpr double kPerSquare = 3;  // [voxels and spacings] edge of the squares that are compared
constexpr double kLargestSquare = 0.5;  // [m] of it
constexpr double kOneFloor = 0.975;     // cosine between the normals of what may be one floor
constexpr double kOn = 0.1;             // [m] what stands on something is at least so high over it

}  // namespace

double height_over(const Plane& a, const Plane& b, const Vec3& p, const Vec3& up) {
  return b.signed_distance(p) / b.normal.dot(up) - a.signed_distance(p) / a.normal.dot(up);
}

FloorPieces::FloorPieces(const Grid& grid, const Clustering& c, const Vec3& up, double max_tilt,
                         double max_height)
    : grid_(grid), c_(c), up_(up), plan_(frame_of(Plane{up, 0})), members_(members_of(c)) {
  boxes_.resize(members_.size());
  std::vector<std::size_t> level;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const Cluster& cluster = c.clusters[k];
    if (members_[k].empty() || std::abs(cluster.fit.plane.normal.dot(up)) < std::cos(max_tilt))
      continue;
    for (const std::uint32_t i : members_[k]) boxes_[k].extend(grid.sites[i].position());
    level.push_back(k);
  }
  std::stable_sort(level.begin(), level.end(), [&](std::size_t a, std::size_t b) {
    return c.clusters[a].moments.n > c.clusters[b].moments.n;
  });
  level_ = level;
  std::erase_if(level, [&](std::size_t k) { return stands_on_another(k, max_height); });
  level_ = std::move(level);
}

bool FloorPieces::are_near(std::size_t a, std::size_t b, double reach) const {
  const Vec3 &p = c_.clusters[a].fit.plane.normal, &q = c_.clusters[b].fit.plane.normal;
  return grown(boxes_[a], reach).intersects(boxes_[b]) && std::abs(p.dot(q)) >= kOneFloor;
}

Encounter FloorPieces::compare(std::size_t larger, std::size_t lesser, double reach) const {
  const double spacing =
      std::sqrt(area_of(c_.clusters[lesser].fit) / c_.clusters[lesser].moments.n);
  const double edge =
      std::max(kPerSquare * grid_.voxel, std::min(kPerSquare * spacing, kLargestSquare));
  const int around = std::max(1, static_cast<int>(std::lround(reach / edge)));
  const Plan here = plan_of(lesser, grown(boxes_[larger], reach), edge),
             there = plan_of(larger, grown(boxes_[lesser], reach), edge);
  Encounter e;
  std::vector<double> offsets, steps;
  for (const auto& [square, place] : here) {
    const bool is_in = is_inside(here, square);
    e.inside += is_in;
    const Vec3 at = place.middle();
    if (const auto found = there.find(square); found != there.end()) {
      e.shared += is_in;
      e.contacts.push_back((at + found->second.middle()) / 2);
      offsets.push_back(height_between(lesser, at, larger, found->second.middle()));
      continue;
    }
    const Place* nearest = nullptr;
    double least = 1e30;
    for (int y = -around; y <= around; ++y)
      for (int x = -around; x <= around; ++x) {
        const Square beside{square.first + x, square.second + y};
        const auto next = there.find(beside);
        if (next == there.end() || here.contains(beside)) continue;
        const double far = (next->second.middle() - at).squaredNorm();
        if (far < least) least = far, nearest = &next->second;
      }
    if (nearest == nullptr) continue;
    e.contacts.push_back((at + nearest->middle()) / 2);
    steps.push_back(height_between(lesser, at, larger, nearest->middle()));
  }
  e.beside = static_cast<double>(steps.size());
  if (steps.size() < 2) steps = offsets;
  const auto count = static_cast<double>(steps.size());
  for (const double s : steps) e.step += s / count;
  for (const double s : steps) e.error += std::pow((s - e.step) / count, 2);
  e.error = std::sqrt(e.error);
  const Plane &a = c_.clusters[larger].fit.plane, &b = c_.clusters[lesser].fit.plane;
  for (const Vec3& p : e.contacts)
    e.between += height_over(b, a, p, up_) / static_cast<double>(e.contacts.size());
  if (!offsets.empty()) e.offset = median(std::move(offsets));
  return e;
}

// Whether all squares beside one are there too.
bool FloorPieces::is_inside(const Plan& plan, const Square& s) {
  return plan.contains({s.first + 1, s.second}) && plan.contains({s.first - 1, s.second}) &&
         plan.contains({s.first, s.second + 1}) && plan.contains({s.first, s.second - 1});
}

bool FloorPieces::stands_on_another(std::size_t k, double max_height) const {
  const Vec3& at = c_.clusters[k].fit.centroid;
  const double area = area_of(c_.clusters[k].fit);
  return std::any_of(level_.begin(), level_.end(), [&](std::size_t other) {
    if (area_of(c_.clusters[other].fit) <= area) return false;
    const Plane& plane = c_.clusters[other].fit.plane;
    const double above = plane.signed_distance(at) / plane.normal.dot(up_);
    return above > kOn && above < max_height &&
           boxes_[other].exteriorDistance(Vec3(at - above * up_)) < kOn;
  });
}

FloorPieces::Plan FloorPieces::plan_of(std::size_t k, const Box3& where, double edge) const {
  Plan plan;
  for (const std::uint32_t i : members_[k]) {
    const Site& s = grid_.sites[i];
    const Vec3 p = s.position();
    if (!where.contains(p)) continue;
    Place& place = plan[square_of(plan_.to_plane(p), edge)];
    place.points += s.points, place.sum += s.points * p;
  }
  return plan;
}

// The height of one surface over another half-way between a place on each.
double FloorPieces::height_between(std::size_t a, const Vec3& at, std::size_t b,
                                   const Vec3& from) const {
  const Vec3 middle = (at + from) / 2;
  const Vec3 &over = c_.clusters[a].fit.plane.normal, &under = c_.clusters[b].fit.plane.normal;
  return under.dot(middle - from) / under.dot(up_) - over.dot(middle - at) / over.dot(up_);
}

}  // namespace scanworld::rival
