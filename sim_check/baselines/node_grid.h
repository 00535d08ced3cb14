// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "types.h"

namespace scanworld::sim {

// Where the nodes of a network are, and which two are nearest to a point, while nodes come, go and
// move. Based on the growing uniform grid of: D. Fiser, J. Faigl, M. Kulich, Growing Neural Gas
// Efficiently, Neurocomputing 104, 2013.
class NodeGrid {
 public:
  // For nodes in this box, more or less: those outside are found too, but slower.
  explicit NodeGrid(const Box3& box);

  void insert(int node, const Vec3& position);  // one that is not there
  void erase(int node);
  void move(int node, const Vec3& position);

  const Vec3& position(int node) const { return positions_[static_cast<std::size_t>(node)]; }
  const std::vector<Vec3>& positions() const { return positions_; }  // those of erased nodes too

  // The nearest node and the next; of equally near ones the lower. At least two must be there.
  std::pair<int, int> nearest_two(const Vec3& point) const;

 private:
  struct Nearest;

  Eigen::Vector3i cell_of(const Vec3& p) const;
  std::size_t index_of(const Eigen::Vector3i& cell) const;
  void link(int node);
  void unlink(int node);
  void rebuild();
  void visit_shell(const Eigen::Vector3i& center, int radius, Nearest& nearest) const;
  void visit_row(int x, int y, int first_z, int last_z, Nearest& nearest) const;
  double reach(const Vec3& point, const Eigen::Vector3i& center, int radius) const;

  Box3 box_;
  double edge_ = 1, per_edge_ = 1;   // [m] of a cell, [1/m]
  Eigen::Vector3i counts_{1, 1, 1};  // of cells
  Vec3 last_ = Vec3::Zero();         // the highest cell
  std::vector<Vec3> positions_;
  std::size_t size_ = 0, built_for_ = 1;  // nodes
  // The nodes of each cell are a doubly linked list.
  std::vector<int> heads_, next_, previous_;
  std::vector<std::size_t> cells_;  // of the nodes
};

}  // namespace scanworld::sim
