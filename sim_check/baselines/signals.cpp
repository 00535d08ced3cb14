// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <tuple>

#include "error.h"
#include "mix.h"

namespace scanworld::sim {

namespace {

// A point with the random number that tells its place in a pass.
struct Draw {
  std::uint64_t key;
  Vec3f point;

  bool operator<(const Draw& other) const {
    if (key != other.key) return key < other.key;
    return std::tuple(point.x(), point.y(), point.z()) <
           std::tuple(other.point.x(), other.point.y(), other.point.z());
  }
};

std::uint64_t hash_of(const Vec3f& p) {
  const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x)}; };
  return mix(mix(bits(p.x()) << 32 | bits(p.y())) ^ bits(p.z()));
}

}  // namespace

Signals::Signals(const PointCloud& cloud, int nodes, std::uint64_t seed)
    : points_(cloud.points), seed_(seed) {
  if (points_.empty() || points_.size() < static_cast<std::size_t>(nodes))
    throw Error(Cause::bad_input, fmt::format("a scan of {} points is too small for {} nodes",
                                              points_.size(), nodes));
  shuffle();
}

Vec3 Signals::next() {
  if (next_ == points_.size()) shuffle();
  return points_[next_++].cast<double>();
}

void Signals::shuffle() {
  const std::uint64_t salt = mix(seed_ ^ mix(++pass_));
  std::vector<Draw> draws;
  draws.reserve(points_.size());
  for (const Vec3f& p : points_) draws.push_back({mix(hash_of(p) ^ salt), p});
  std::sort(draws.begin(), draws.end());
  for (std::size_t i = 0; i < draws.size(); ++i) points_[i] = draws[i].point;
  next_ = 0;
}

Box3 Signals::box() const {
  Box3 box;
  for (const Vec3f& p : points_) box.extend(p.cast<double>());
  return box;
}

std::vector<Vec3> Signals::next_distinct(std::size_t count) {
  std::vector<Vec3> found;
  for (std::size_t drawn = 0; drawn < points_.size() && found.size() < count; ++drawn) {
    const Vec3 p = next();
    if (std::find(found.begin(), found.end(), p) == found.end()) found.push_back(p);
  }
  if (found.size() < count)
    throw Error(
        Cause::bad_input,
        fmt::format("a scan of {} points has fewer than {} different ones", points_.size(), count));
  return found;
}

}  // namespace scanworld::sim
