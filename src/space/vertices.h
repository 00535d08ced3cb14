// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The vertices of a cell complex: one for each place where planes meet, whichever three of them
// name it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "exact.h"

namespace scanworld::space {

// Numbers by key, in open addressing: a look-up touches one line of the cache.
class NumberTable {
 public:
  // The number that was put in with this key and that is_it(number) says is meant, -1: none.
  template <typename IsIt>
  int find(std::uint64_t key, const IsIt& is_it) const {
    if (slots_.empty()) return -1;
    for (std::size_t i = home_of(key); slots_[i].number >= 0; i = (i + 1) & (slots_.size() - 1))
      if (slots_[i].key == key && is_it(slots_[i].number)) return slots_[i].number;
    return -1;
  }
  void insert(std::uint64_t key, int number);

 private:
  struct Slot {
    std::uint64_t key = 0;
    int number = -1;
  };
  std::size_t home_of(std::uint64_t key) const;

  std::vector<Slot> slots_;  // a power of two, at most half of them taken
  std::size_t taken_ = 0;
};

class Vertices {
 public:
  // `middle` is the zero point of the planes in the caller's coordinates.
  Vertices(double unit, const Vec3& middle) : unit_(unit), middle_(middle) {}

  // The vertex where these three of the planes meet, which they must. Planes keep their numbers.
  int where_meet(const std::vector<ExactPlane>& planes, std::array<int, 3> three);

  std::size_t size() const { return vertices_.size(); }
  const ExactPoint& point(int index) const { return vertices_[at(index)].point; }
  const Vec3& relative(int index) const { return vertices_[at(index)].relative; }
  const Vec3& place(int index) const { return places_[at(index)]; }

  // Three planes that it is on; there may be more.
  const std::array<int, 3>& planes_of(int index) const { return vertices_[at(index)].planes; }

 private:
  struct Vertex {
    ExactPoint point;
    Vec3 relative;  // to the middle
    std::array<int, 3> planes;
  };
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }

  double unit_;
  Vec3 middle_;
  std::vector<Vertex> vertices_;
  std::vector<Vec3> places_;  // in the caller's coordinates
  NumberTable of_planes_, of_point_;
};

}  // namespace scanworld::space
