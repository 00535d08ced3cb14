// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../types.h"

namespace scanworld::thesis {

// A static kd-tree of three dimensions; every node is a point.
// Based on: V. Petrik, Spatial Models in Mobile Robotics, 2012, Algorithms 1 and 2. Ties on an axis
// are broken by the other coordinates, so that the tree depends on the points alone, not on their
// order.
class KdTree {
 public:
  explicit KdTree(std::vector<Vec3> points);

  const std::vector<Vec3>& points() const { return points_; }

  // Calls visit(index) for each point of the closed box [min, max] (Algorithm 2).
  template <typename Visit>
  void range_search(const Vec3& min, const Vec3& max, Visit visit) const {
    search({0, nodes_.size(), 0}, min, max, visit);
  }
  std::vector<int> range_search(const Vec3& min, const Vec3& max) const;

  // The points in the order of a breadth-first walk from the root, which spreads them evenly over
  // the set.
  std::vector<int> breadth_first() const;

 private:
  // The nodes of a subtree are nodes_[begin, end); its root stands in the middle.
  struct Subtree {
    std::size_t begin, end;
    int axis;
    bool empty() const { return begin == end; }
    std::size_t root() const { return begin + (end - begin) / 2; }
    Subtree left() const { return {begin, root(), (axis + 1) % 3}; }
    Subtree right() const { return {root() + 1, end, (axis + 1) % 3}; }
  };

  void build(Subtree tree);

  template <typename Visit>
  void search(Subtree tree, const Vec3& min, const Vec3& max, Visit& visit) const {
    if (tree.empty()) return;
    const int index = nodes_[tree.root()];
    const Vec3& p = points_[static_cast<std::size_t>(index)];
    if (p[tree.axis] < min[tree.axis]) return search(tree.right(), min, max, visit);
    if (p[tree.axis] > max[tree.axis]) return search(tree.left(), min, max, visit);
    search(tree.left(), min, max, visit);
    search(tree.right(), min, max, visit);
    if ((p.array() >= min.array()).all() && (p.array() <= max.array()).all()) visit(index);
  }

  std::vector<Vec3> points_;
  std::vector<int> nodes_;  // indices of points
};

inline std::size_t count_of(const KdTree& tree) { return tree.points().size(); }

}  // namespace scanworld::thesis
