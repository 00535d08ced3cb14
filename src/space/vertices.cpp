// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "vertices.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "../mix.h"

namespace scanworld::space {
namespace {

constexpr int kPlaneBits = 21;

std::uint64_t key_of_planes(const std::array<int, 3>& sorted) {
  assert(sorted[2] < 1 << kPlaneBits);
  std::uint64_t key = 0;
  for (int p : sorted) key = key << kPlaneBits | static_cast<std::uint64_t>(p);
  return key;
}

std::uint64_t key_of_point(const ExactPoint& point) {
  auto key = static_cast<std::uint64_t>(point.w);
  for (const Int128 v : {point.x, point.y, point.z}) {
    key = mix(key) ^ static_cast<std::uint64_t>(v);
    key = mix(key) ^ static_cast<std::uint64_t>(v >> 64);
  }
  return key;
}

}  // namespace

std::size_t NumberTable::home_of(std::uint64_t key) const { return mix(key) & (slots_.size() - 1); }

void NumberTable::insert(std::uint64_t key, int number) {
  if (2 * (taken_ + 1) > slots_.size()) {
    const std::vector<Slot> old =
        std::exchange(slots_, std::vector<Slot>(std::max<std::size_t>(64, 2 * slots_.size())));
    taken_ = 0;
    for (const Slot& slot : old)
      if (slot.number >= 0) insert(slot.key, slot.number);
  }
  std::size_t i = home_of(key);
  while (slots_[i].number >= 0) i = (i + 1) & (slots_.size() - 1);
  slots_[i] = {key, number};
  ++taken_;
}

int Vertices::where_meet(const std::vector<ExactPlane>& planes, std::array<int, 3> three) {
  std::sort(three.begin(), three.end());
  const std::uint64_t key = key_of_planes(three);
  if (const int known = of_planes_.find(key, [](int) { return true; }); known >= 0) return known;
  const std::optional<ExactPoint> point =
      meet(planes[at(three[0])], planes[at(three[1])], planes[at(three[2])]);
  assert(point);
  const std::uint64_t point_key = key_of_point(*point);
  int vertex = of_point_.find(point_key, [&](int v) { return vertices_[at(v)].point == *point; });
  if (vertex < 0) {
    vertex = static_cast<int>(vertices_.size());
    const Vec3 relative = place_of(*point, unit_);
    vertices_.push_back({*point, relative, three});
    places_.push_back(middle_ + relative);
    of_point_.insert(point_key, vertex);
  }
  of_planes_.insert(key, vertex);
  return vertex;
}

}  // namespace scanworld::space
