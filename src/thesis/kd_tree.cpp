// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "kd_tree.h"

#include <algorithm>
#include <numeric>

#include "../parallel.h"

namespace scanworld::thesis {

KdTree::KdTree(std::vector<Vec3> points) : points_(std::move(points)), nodes_(points_.size()) {
  std::iota(nodes_.begin(), nodes_.end(), 0);
  build({0, nodes_.size(), 0});
}

void KdTree::build(Subtree tree) {
  if (tree.empty()) return;
  const auto before = [&](int a, int b) {
    const Vec3 &p = points_[static_cast<std::size_t>(a)], &q = points_[static_cast<std::size_t>(b)];
    for (int k = 0; k < 3; ++k) {
      const int axis = (tree.axis + k) % 3;
      if (p[axis] != q[axis]) return p[axis] < q[axis];
    }
    return a < b;
  };
  const auto at = [&](std::size_t i) { return nodes_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(tree.begin), at(tree.root()), at(tree.end), before);
  constexpr std::size_t kLarge = 1 << 14;  // nodes that are worth another thread
  if (tree.end - tree.begin > kLarge)
    return parallel_for(2,
                        [&](std::size_t side) { build(side == 0 ? tree.left() : tree.right()); });
  build(tree.left());
  build(tree.right());
}

std::vector<int> KdTree::range_search(const Vec3& min, const Vec3& max) const {
  std::vector<int> found;
  range_search(min, max, [&](int index) { found.push_back(index); });
  return found;
}

std::vector<int> KdTree::breadth_first() const {
  std::vector<int> order;
  order.reserve(nodes_.size());
  std::vector<Subtree> level = {{0, nodes_.size(), 0}}, next;
  while (!level.empty()) {
    next.clear();
    for (const Subtree& tree : level) {
      if (tree.empty()) continue;
      order.push_back(nodes_[tree.root()]);
      next.push_back(tree.left());
      next.push_back(tree.right());
    }
    level.swap(next);
  }
  return order;
}

}  // namespace scanworld::thesis
