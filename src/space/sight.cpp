// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sight.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "../cell_walk.h"
#include "../parallel.h"

namespace scanworld::space {

namespace {

// A cell hides what is behind it if it holds points of a plane, or so many places: a few flying
// pixels hide nothing.
constexpr int kLoosePlaces = 3;

// Clear of the plane that is looked at, in cells: its own points do not hide it.
constexpr double kClear = 1.2;

}  // namespace

Sight::Sight(const surface::Surroundings& around, const std::vector<std::int32_t>& viewers,
             double spacing, const SightOptions& options, const Vec3& up)
    : viewpoints_(around.viewpoints),
      options_(options),
      up_(up),
      cell_(std::max(options.cell, options.sites * spacing)) {
  std::unordered_map<std::uint64_t, int> loose;
  for (std::size_t i = 0; i < around.points.size(); ++i) {
    const Vec3 p = around.points[i].cast<double>();
    if (!has_code(p, cell_)) continue;
    const std::uint64_t code = morton_of(cell_of(p, cell_));
    if (around.planes[i] >= 0 || ++loose[code] == kLoosePlaces) occupied_.insert(code);
  }
  std::vector<Directions> returns(viewpoints_.size());
  for (std::size_t i = 0; i < viewers.size(); ++i) {
    if (viewers[i] < 0) continue;
    const auto v = static_cast<std::size_t>(viewers[i]);
    if (returns[v].empty()) returns[v].assign(kAzimuths * kElevations, 0);
    returns[v][direction_of(around.points[i].cast<double>() - viewpoints_[v])] = 1;
  }
  seen_.resize(returns.size());
  parallel_for(seen_.size(), [&](std::size_t v) {
    if (!returns[v].empty()) seen_[v] = field_of_view(returns[v]);
  });
}

std::size_t Sight::direction_of(const Vec3& way) {
  const double azimuth = std::atan2(way.y(), way.x()) / (2 * std::numbers::pi) + 0.5,
               elevation =
                   std::atan2(way.z(), std::hypot(way.x(), way.y())) / std::numbers::pi + 0.5;
  const int a = std::min(kAzimuths - 1, static_cast<int>(azimuth * kAzimuths)),
            e = std::min(kElevations - 1, static_cast<int>(elevation * kElevations));
  return static_cast<std::size_t>(e * kAzimuths + a);
}

Sight::Directions Sight::field_of_view(const Directions& returns) {
  constexpr int kBeside = 40;  // directions to the left and right
  const auto is_return = [&](int a, int e) {
    return returns[static_cast<std::size_t>(e * kAzimuths + (a + kAzimuths) % kAzimuths)] != 0;
  };
  Directions seen(returns.size(), 0);
  for (int a = 0; a < kAzimuths; ++a) {
    int lowest = kElevations, highest = -1;
    for (int e = 0; e < kElevations; ++e)
      if (is_return(a, e)) lowest = std::min(lowest, e), highest = e;
    for (int e = lowest; e <= highest; ++e) {
      bool left = is_return(a, e), right = left;
      for (int x = 1; x < kBeside && !left; ++x) left = is_return(a + x, e);
      for (int x = 1; x < kBeside && !right && left; ++x) right = is_return(a - x, e);
      seen[static_cast<std::size_t>(e * kAzimuths + a)] = left && right;
    }
  }
  return seen;
}

bool Sight::is_hidden(const Vec3& place, const Vec3& normal, const Vec3& to) const {
  const Vec3 way = to - place;
  const double length = way.norm();
  if (length < kClear * cell_) return false;
  if (!has_code(place, cell_) || !has_code(to, cell_)) return true;
  bool hidden = false;
  CellSet::Reader occupied(occupied_);
  walk_cells((place + way * (kClear * cell_ / length)) / cell_, cell_of(to, cell_),
             [&](std::uint64_t code) {
               if (!occupied.contains(code)) return true;
               hidden = normal.dot(middle_of_cell(code, cell_) - place) > kClear * cell_;
               return !hidden;
             });
  return hidden;
}

// Under a scanner nobody knows of, the floor has no points either; in a stairwell something is
// seen below.
bool Sight::has_below(const Vec3& place) const {
  for (double depth = 2 * cell_; depth < options_.look_below; depth += cell_)
    if (is_occupied(place - depth * up_)) return true;
  return false;
}

bool Sight::is_exposed(const Vec3& place, const Vec3& normal) const {
  if (viewpoints_.empty())
    return !is_hidden(place, normal, place + options_.look_ahead * normal) &&
           (normal.dot(up_) < kLevelCosine || has_below(place));
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t v = 0; v < viewpoints_.size(); ++v)
    if (!seen_[v].empty() && normal.dot(viewpoints_[v] - place) > 0)
      near.emplace_back((viewpoints_[v] - place).squaredNorm(), v);
  const auto asked = near.begin() + std::min(static_cast<std::ptrdiff_t>(near.size()),
                                             static_cast<std::ptrdiff_t>(options_.viewers));
  std::partial_sort(near.begin(), asked, near.end());
  return std::any_of(near.begin(), asked, [&](const auto& candidate) {
    const Vec3& from = viewpoints_[candidate.second];
    const Vec3 way = from - place;
    const double length = std::sqrt(candidate.first);
    if (normal.dot(way) < options_.min_cosine * length) return false;
    if (!seen_[candidate.second][direction_of(-way)]) return false;
    return length < options_.blind ||
           !is_hidden(place, normal, from - way * (options_.blind / length));
  });
}

bool Sight::is_occupied(const Vec3& place) const { return occupied_.contains(place, cell_); }

}  // namespace scanworld::space
