// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "thesis/kd_tree.h"

#include <algorithm>
#include <set>

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;
using thesis::KdTree;

namespace {

// Points on a coarse grid, so that many coordinates and points are the same.
std::vector<Vec3> grid_points(Random& random, int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(random.whole(0, 6), random.whole(0, 4), random.whole(0, 3));
  return points;
}

}  // namespace

TEST_CASE("range search finds what a search of all points finds, faces of the box included") {
  Random random(1);
  for (int round = 0; round < 60; ++round) {
    const std::vector<Vec3> points = grid_points(random, random.whole(0, 300));
    const KdTree tree(points);
    for (int query = 0; query < 20; ++query) {
      const Vec3 a(random.whole(-1, 7), random.whole(-1, 5), random.whole(-1, 4)),
          b(random.whole(-1, 7), random.whole(-1, 5), random.whole(-1, 4));
      const Vec3 min = a.cwiseMin(b), max = a.cwiseMax(b);
      std::vector<int> expected, found = tree.range_search(min, max);
      for (std::size_t i = 0; i < points.size(); ++i)
        if ((points[i].array() >= min.array()).all() && (points[i].array() <= max.array()).all())
          expected.push_back(static_cast<int>(i));
      std::sort(found.begin(), found.end());
      CHECK(found == expected);
    }
  }
}

TEST_CASE("an empty tree, one point and many equal points are searched") {
  CHECK(KdTree({}).range_search(Vec3::Constant(-1), Vec3::Constant(1)).empty());
  CHECK(KdTree({}).breadth_first().empty());
  CHECK(KdTree({Vec3::Zero()}).range_search(Vec3::Zero(), Vec3::Zero()).size() == 1);
  CHECK(KdTree(std::vector<Vec3>(10000, Vec3::Ones()))
            .range_search(Vec3::Zero(), Vec3::Ones())
            .size() == 10000);
}

TEST_CASE(
    "breadth-first order holds each point once, starts at the median and spreads over the set") {
  Random random(2);
  std::vector<Vec3> points;
  for (int i = 0; i < 1023; ++i)
    points.emplace_back(random.uniform(), random.uniform(), random.uniform());
  const KdTree tree(points);
  const std::vector<int> order = tree.breadth_first();
  CHECK(std::set<int>(order.begin(), order.end()).size() == points.size());
  std::vector<double> xs;
  for (const Vec3& p : points) xs.push_back(p.x());
  std::nth_element(xs.begin(), xs.begin() + 511, xs.end());
  CHECK(points[static_cast<std::size_t>(order[0])].x() == xs[511]);
  // The first 15 points are on four levels of the tree: some lie in each quarter along x and y.
  int quarters[4] = {};
  for (int i = 0; i < 15; ++i) {
    const Vec3& p = points[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])];
    ++quarters[(p.x() > 0.5) * 2 + (p.y() > 0.5)];
  }
  for (int n : quarters) CHECK(n >= 2);
}

TEST_CASE("the order of the points given does not matter to the tree") {
  Random random(3);
  std::vector<Vec3> points = grid_points(random, 500);
  const auto walk = [](const std::vector<Vec3>& p) {
    std::vector<Vec3> walked;
    for (int i : KdTree(p).breadth_first()) walked.push_back(p[static_cast<std::size_t>(i)]);
    return walked;
  };
  const auto before = walk(points);
  shuffle(points, random);
  CHECK(walk(points) == before);
}
