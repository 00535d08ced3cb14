// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "node_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scanworld::sim {

namespace {

constexpr double kDensity = 0.1;    // nodes in a cell, on average, when the grid is built
constexpr double kExpansion = 1.5;  // it is built anew for so many times as many
constexpr double kThinnest = 1e-3;  // of the longest side: what a flat box is taken for
constexpr int kFree = -1, kNotThere = -2;

}  // namespace

// The nearest two so far. An infinite distance means none.
struct NodeGrid::Nearest {
  Vec3 point;
  double first_distance = std::numeric_limits<double>::infinity(),
         second_distance = first_distance;  // [m2] squared
  int first = kFree, second = kFree;

  void consider(int node, const Vec3& position) {
    const double distance = (position - point).squaredNorm();
    if (distance > second_distance) return;
    if (std::pair(distance, node) < std::pair(first_distance, first)) {
      second_distance = first_distance, second = first;
      first_distance = distance, first = node;
    } else if (std::pair(distance, node) < std::pair(second_distance, second)) {
      second_distance = distance, second = node;
    }
  }
};

NodeGrid::NodeGrid(const Box3& box) : box_(box) { rebuild(); }

void NodeGrid::insert(int node, const Vec3& position) {
  const auto i = static_cast<std::size_t>(node);
  if (i >= positions_.size()) {
    positions_.resize(i + 1);
    cells_.resize(i + 1);
    next_.resize(i + 1, kNotThere);
    previous_.resize(i + 1, kNotThere);
  }
  positions_[i] = position;
  link(node);
  if (static_cast<double>(++size_) > kExpansion * static_cast<double>(built_for_)) rebuild();
}

void NodeGrid::erase(int node) {
  unlink(node);
  --size_;
}

void NodeGrid::move(int node, const Vec3& position) {
  const auto i = static_cast<std::size_t>(node);
  positions_[i] = position;
  if (index_of(cell_of(position)) == cells_[i]) return;
  unlink(node);
  link(node);
}

std::pair<int, int> NodeGrid::nearest_two(const Vec3& point) const {
  const Eigen::Vector3i center = cell_of(point);
  Nearest nearest{point};
  for (int radius = 0;; ++radius) {
    visit_shell(center, radius, nearest);
    const double seen = reach(point, center, radius);
    if (nearest.second_distance < seen * seen) return {nearest.first, nearest.second};
  }
}

Eigen::Vector3i NodeGrid::cell_of(const Vec3& p) const {
  return ((p - box_.min()) * per_edge_).cwiseMax(0).cwiseMin(last_).cast<int>();
}

std::size_t NodeGrid::index_of(const Eigen::Vector3i& cell) const {
  return static_cast<std::size_t>((cell[0] * counts_[1] + cell[1]) * counts_[2] + cell[2]);
}

void NodeGrid::link(int node) {
  const auto i = static_cast<std::size_t>(node);
  cells_[i] = index_of(cell_of(positions_[i]));
  int& head = heads_[cells_[i]];
  next_[i] = head;
  previous_[i] = kFree;
  if (head != kFree) previous_[static_cast<std::size_t>(head)] = node;
  head = node;
}

void NodeGrid::unlink(int node) {
  const auto i = static_cast<std::size_t>(node);
  if (previous_[i] == kFree)
    heads_[cells_[i]] = next_[i];
  else
    next_[static_cast<std::size_t>(previous_[i])] = next_[i];
  if (next_[i] != kFree) previous_[static_cast<std::size_t>(next_[i])] = previous_[i];
  next_[i] = previous_[i] = kNotThere;
}

void NodeGrid::rebuild() {
  built_for_ = std::max(size_, std::size_t{1});
  const Vec3 size = box_.sizes();
  const Vec3 solid = size.cwiseMax(std::max(kThinnest * size.maxCoeff(), 1e-9));
  edge_ = std::cbrt(solid.prod() * kDensity / static_cast<double>(built_for_));
  per_edge_ = 1 / edge_;
  counts_ = (size * per_edge_).cast<int>() + Eigen::Vector3i::Ones();
  last_ = (counts_ - Eigen::Vector3i::Ones()).cast<double>();
  heads_.assign(static_cast<std::size_t>(counts_.prod()), kFree);
  for (std::size_t i = 0; i < positions_.size(); ++i)
    if (next_[i] != kNotThere) link(static_cast<int>(i));
}

// The cells that are `radius` from the center along the axis where they are farthest.
void NodeGrid::visit_shell(const Eigen::Vector3i& center, int radius, Nearest& nearest) const {
  const auto low = [&](int k) { return std::max(center[k] - radius, 0); };
  const auto high = [&](int k) { return std::min(center[k] + radius, counts_[k] - 1); };
  for (int x = low(0); x <= high(0); ++x)
    for (int y = low(1); y <= high(1); ++y) {
      if (std::max(std::abs(x - center[0]), std::abs(y - center[1])) == radius) {
        visit_row(x, y, low(2), high(2), nearest);
        continue;
      }
      for (int z : {center[2] - radius, center[2] + radius})
        if (z >= 0 && z < counts_[2]) visit_row(x, y, z, z, nearest);
    }
}

void NodeGrid::visit_row(int x, int y, int first_z, int last_z, Nearest& nearest) const {
  const std::size_t first = index_of({x, y, first_z}), last = index_of({x, y, last_z});
  for (std::size_t cell = first; cell <= last; ++cell)
    for (int node = heads_[cell]; node != kFree; node = next_[static_cast<std::size_t>(node)])
      nearest.consider(node, positions_[static_cast<std::size_t>(node)]);
}

// [m] How far all is seen when the shells up to this radius were visited.
double NodeGrid::reach(const Vec3& point, const Eigen::Vector3i& center, int radius) const {
  double seen = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double offset = point[k] - box_.min()[k];
    const int low = center[k] - radius, high = center[k] + radius;
    // The cells at the ends have what is beyond them, too.
    if (low > 0) seen = std::min(seen, offset - low * edge_);
    if (high < counts_[k] - 1) seen = std::min(seen, (high + 1) * edge_ - offset);
  }
  return seen;
}

}  // namespace scanworld::sim
