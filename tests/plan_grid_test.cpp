// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/plan_grid.h"

#include <map>

#include "polygon.h"
#include "support/support.h"
#include "world/convex_parts.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

std::vector<Vec2> random_convex(Random& random) {
  std::vector<Vec2> points;
  for (int k = random.whole(2, 7); k >= 0; --k)
    points.emplace_back(random.uniform(-1, 2), random.uniform(-1, 2));
  return convex_hull(points);
}

const PlanGrid kGrid = grid_over({Vec2(0, 0), Vec2(1, 1)}, 0.05);

}  // namespace

TEST_CASE("a grid holds its box, with borders at multiples of its cells") {
  Random random(1);
  for (int k = 0; k < 200; ++k) {
    const double cell = random.uniform(0.01, 0.3);
    Rectangle box(Vec2(random.uniform(-90, 90), random.uniform(-90, 90)));
    box.extend(Vec2(box.min() + Vec2(random.uniform(0, 9), random.uniform(0, 9))));
    const PlanGrid grid = grid_over(box, cell);
    for (const Vec2& p : {Vec2(box.min()), Vec2(box.max()), Vec2(box.center())}) {
      const auto i = grid.at(p);
      REQUIRE(i);
      CHECK((grid.center(*i) - p).cwiseAbs().maxCoeff() < cell * 0.5001);
    }
    CHECK_FALSE(grid.at(grid.corner - Vec2(0.001, -0.001)));
    const Vec2 steps = grid.corner / cell;
    CHECK((steps - steps.array().round().matrix()).norm() < 1e-9);
    CHECK(static_cast<double>(grid.size()) <= cell_count(box, cell) + 1e-6);
  }
  CHECK(grid_over({}, 0.05).size() == 1);
}

TEST_CASE("cells that a polygon touches have a point of it, and all of its points are in one") {
  Random random(2);
  for (int k = 0; k < 300; ++k) {
    const std::vector<Vec2> ring = random_convex(random);
    std::map<std::size_t, int> touched;
    visit_touched(kGrid, ring, [&](std::size_t i) { ++touched[i]; });
    for (const auto& [i, times] : touched) {
      CHECK(times == 1);
      // What of the polygon is in the cell.
      const Vec2 c = kGrid.center(i);
      std::vector<Vec2> part = ring;
      for (const Vec2& n : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)})
        part = clipped<Vec2>(part, n, n.dot(c) + 0.025 + 1e-9);
      CHECK_FALSE(part.empty());
    }
    for (int j = 0; j < 50; ++j) {
      Vec2 p = Vec2::Zero();
      double sum = 0;
      for (const Vec2& corner : ring) {
        const double w = random.uniform();
        p += w * corner, sum += w;
      }
      if (const auto i = kGrid.at(p / sum)) CHECK(touched.count(*i) == 1);
    }
  }
}

TEST_CASE("a segment and a point touch the cells that they are in") {
  std::vector<std::size_t> cells;
  const auto visit = [&](std::size_t i) { cells.push_back(i); };
  visit_touched(kGrid, {Vec2(0.51, 0.52)}, visit);
  CHECK(cells == std::vector<std::size_t>{*kGrid.at({0.51, 0.52})});
  cells.clear();
  visit_touched(kGrid, {Vec2(0.12, 0.02), Vec2(0.12, 0.93)}, visit);
  CHECK(cells.size() == 19);
  cells.clear();
  visit_touched(kGrid, {}, visit);
  visit_covered(kGrid, {}, visit);
  CHECK(cells.empty());
}

TEST_CASE("cells that a polygon covers are those whose centre it holds; neighbours share none") {
  Random random(3);
  for (int k = 0; k < 300; ++k) {
    const std::vector<Vec2> ring = random_convex(random);
    if (ring.size() < 3) continue;
    std::map<std::size_t, int> covered;
    // As a fan of triangles.
    for (std::size_t t = 1; t + 1 < ring.size(); ++t)
      visit_covered(kGrid, {ring[0], ring[t], ring[t + 1]}, [&](std::size_t i) { ++covered[i]; });
    for (std::size_t i = 0; i < kGrid.size(); ++i) {
      if (distance_to_ring(kGrid.center(i), ring) < 1e-9) continue;
      CHECK(covered[i] == (is_inside({ring}, kGrid.center(i)) ? 1 : 0));
    }
  }
}
