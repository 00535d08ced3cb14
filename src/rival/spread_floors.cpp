// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "spread_floors.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace scanworld::rival {

namespace {

constexpr double kLevel = 0.98;      // cosine of a floor's tilt, at least
constexpr double kMinFloor = 2.0;    // [m2] tables are smaller
constexpr double kWithin = 0.95;     // share of a carpet's sites that are near the floor
constexpr double kSurrounded = 0.4;  // share of those at its edge that are beside the floor

class FloorSpreader {
 public:
  FloorSpreader(const PointCloud& cloud, const Grid& grid, const Neighbors& neighbors,
                LabelledPoints labelled, const Vec3& up, double tolerance)
      : cloud_(cloud),
        grid_(grid),
        neighbors_(neighbors),
        result_(std::move(labelled)),
        sites_(result_.sites),
        up_(up),
        tolerance_(tolerance),
        area_(result_.planes.size()) {
    for (const std::int32_t plane : sites_)
      if (plane != kNone) area_[static_cast<std::size_t>(plane)] += grid.voxel * grid.voxel;
  }

  LabelledPoints spread() {
    take_carpets();
    std::vector<std::uint32_t> front;
    for (std::uint32_t i = 0; i < sites_.size(); ++i)
      if (sites_[i] == kNone) front.push_back(i);
    while (!front.empty()) front = grow(front);
    return std::move(result_);
  }

 private:
  const Plane& plane_of(std::int32_t label) const {
    return result_.planes[static_cast<std::size_t>(label)].fit.plane;
  }

  double area_of(std::int32_t label) const { return area_[static_cast<std::size_t>(label)]; }

  double off(std::int32_t label, const Vec3& p) const {
    return std::abs(plane_of(label).signed_distance(p));
  }

  bool is_level(std::int32_t label) const {
    return std::abs(plane_of(label).normal.dot(up_)) > kLevel;
  }

  bool takes(std::int32_t label, const Vec3& p) const {
    return label != kNone && off(label, p) <= tolerance_ && area_of(label) > kMinFloor &&
           is_level(label);
  }

  // Planes that lie on a larger floor become part of it, the smallest first.
  void take_carpets() {
    std::vector<std::vector<std::uint32_t>> sites_of(area_.size());
    for (std::uint32_t i = 0; i < sites_.size(); ++i)
      if (sites_[i] != kNone) sites_of[static_cast<std::size_t>(sites_[i])].push_back(i);
    std::vector<std::int32_t> order;
    for (std::size_t k = 0; k < area_.size(); ++k)
      if (!sites_of[k].empty() && is_level(static_cast<std::int32_t>(k)))
        order.push_back(static_cast<std::int32_t>(k));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::int32_t a, std::int32_t b) { return area_of(a) < area_of(b); });
    std::vector<std::int32_t> floor_of(area_.size(), kNone);
    for (const std::int32_t carpet : order) {
      const auto k = static_cast<std::size_t>(carpet);
      const std::int32_t floor = floor_under(carpet, sites_of[k]);
      if (floor == kNone) continue;
      floor_of[k] = floor;
      for (const std::uint32_t i : sites_of[k]) sites_[i] = floor;
      const auto f = static_cast<std::size_t>(floor);
      sites_of[f].insert(sites_of[f].end(), sites_of[k].begin(), sites_of[k].end());
    }
    for (std::size_t point = 0; point < result_.labels.size(); ++point) {
      std::int32_t& label = result_.labels[point];
      while (label != kNone && floor_of[static_cast<std::size_t>(label)] != kNone)
        label = floor_of[static_cast<std::size_t>(label)];
    }
  }

  // The larger floor that a plane lies on, or none.
  std::int32_t floor_under(std::int32_t carpet, const std::vector<std::uint32_t>& own) const {
    std::map<std::int32_t, std::size_t> beside;  // sites at the edge, by the floor there
    std::size_t edge = 0;
    for (const std::uint32_t i : own) {
      bool is_edge = false;
      std::int32_t floor = kNone;
      for (const std::uint32_t other : neighbors_.of(i)) {
        if (sites_[other] == carpet) continue;
        is_edge = true;
        if (takes(sites_[other], grid_.sites[i].position()) &&
            area_of(sites_[other]) > area_of(carpet))
          floor = sites_[other];
      }
      edge += is_edge;
      if (floor != kNone) ++beside[floor];
    }
    for (const auto& [floor, count] : beside) {
      if (static_cast<double>(count) < kSurrounded * static_cast<double>(edge)) continue;
      const auto near = std::count_if(own.begin(), own.end(), [&, f = floor](std::uint32_t i) {
        return off(f, grid_.sites[i].position()) <= tolerance_;
      });
      if (static_cast<double>(near) >= kWithin * static_cast<double>(own.size())) return floor;
    }
    return kNone;
  }

  // The nearest floor of those around, the first of equals.
  std::int32_t nearest_floor(std::uint32_t site) const {
    const Vec3 p = grid_.sites[site].position();
    std::int32_t best = kNone;
    for (const std::uint32_t other : neighbors_.of(site))
      if (const std::int32_t plane = sites_[other];
          takes(plane, p) &&
          (best == kNone || std::pair{off(plane, p), plane} < std::pair{off(best, p), best}))
        best = plane;
    return best;
  }

  // Gives sites of no plane to floors beside them; those that may follow. All of a round look at
  // what was before it, so that their order does not matter.
  std::vector<std::uint32_t> grow(const std::vector<std::uint32_t>& front) {
    std::vector<std::pair<std::uint32_t, std::int32_t>> found;
    for (const std::uint32_t i : front)
      if (const std::int32_t plane = nearest_floor(i); plane != kNone) found.emplace_back(i, plane);
    for (const auto& [i, plane] : found) {
      sites_[i] = plane;
      for (const std::uint32_t point : grid_.points_of(i))
        if (result_.labels[point] == kNone && takes(plane, cloud_.points[point].cast<double>()))
          result_.labels[point] = plane;
    }
    std::vector<std::uint32_t> next;
    for (const auto& [i, plane] : found)
      for (const std::uint32_t other : neighbors_.of(i))
        if (sites_[other] == kNone && takes(plane, grid_.sites[other].position()))
          next.push_back(other);
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    return next;
  }

  const PointCloud& cloud_;
  const Grid& grid_;
  const Neighbors& neighbors_;
  LabelledPoints result_;
  std::vector<std::int32_t>& sites_;  // of the result
  const Vec3 up_;
  const double tolerance_;
  std::vector<double> area_;  // [m2] of each plane
};

}  // namespace

LabelledPoints spread_floors(const PointCloud& cloud, const Grid& grid, const Neighbors& neighbors,
                             LabelledPoints labelled, const Vec3& up, double tolerance) {
  return FloorSpreader(cloud, grid, neighbors, std::move(labelled), up, tolerance).spread();
}

}  // namespace scanworld::rival
