// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/raster_outlines.h"

#include <cmath>
#include <numeric>

#include "polygon.h"
#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

namespace {

Raster drawn_raster(int width, int height, const std::function<bool(const Vec2&)>& is_set) {
  Raster raster{.low = {-3, 2}, .cell = 0.1, .width = width, .height = height};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) raster.bits.push_back(is_set(raster.middle(x, y)));
  return raster;
}

double area_of(const std::vector<Ring>& rings) {
  return std::accumulate(rings.begin(), rings.end(), 0.0, [](double sum, const Ring& ring) {
    return sum + doubled_area(ring.points) / 2;
  });
}

}  // namespace

TEST_CASE("loops go around what is set, to their left, and around all of it") {
  Random random(4);
  const Raster raster = drawn_raster(31, 19, [&](const Vec2&) { return random.whole(1, 3) > 1; });
  double edges = 0;
  for (int y = 0; y <= raster.height; ++y)
    for (int x = 0; x <= raster.width; ++x)
      edges += (raster.is_set(x, y) != raster.is_set(x - 1, y)) +
               (raster.is_set(x, y) != raster.is_set(x, y - 1));
  double traced = 0;
  for (const auto& loop : trace_raster(raster)) {
    traced += static_cast<double>(loop.size());
    for (std::size_t k = 0; k < loop.size(); ++k) {
      // Edges between middles turn by half a cell at each corner.
      const Vec2 step = loop[(k + 1) % loop.size()] - loop[k];
      CHECK(step.norm() < 1.01 * raster.cell);
    }
  }
  CHECK(traced == edges);
}

TEST_CASE("an L keeps its corner, and the window in it its own ring after it") {
  const Raster raster = drawn_raster(60, 60, [](const Vec2& p) {
    const bool in_l =
        p.x() > -2.5 && p.y() > 2.5 && p.x() < 2.5 && p.y() < 7.5 && (p.x() < 0 || p.y() < 5);
    const bool in_window = p.x() > -2 && p.x() < -1 && p.y() > 5.5 && p.y() < 6.5;
    return in_l && !in_window;
  });
  const std::vector<Ring> rings = outline_rings(raster);
  REQUIRE(rings.size() == 2);
  CHECK_FALSE(rings[0].is_hole);
  CHECK(rings[1].is_hole);
  CHECK(rings[0].points.size() <= 12);
  CHECK(std::abs(area_of(rings) - (25 - 6.25 - 1)) < 0.3);
  CHECK_FALSE(is_inside({rings[0].points}, {1, 6}));
}

TEST_CASE(
    "rings have the area of a turned shape, by few corners, and holes follow what holds them") {
  for (double turn : {0.1, 0.4, 1.2}) {
    const Eigen::Rotation2Dd rotation(turn);
    const Raster raster = drawn_raster(140, 140, [&](const Vec2& p) {
      const Vec2 q = rotation * (p - Vec2(4, 9));
      const auto in_square = [&](double half) { return q.cwiseAbs().maxCoeff() < half; };
      return in_square(4) && (!in_square(3) || (in_square(2) && !in_square(1)));
    });
    const std::vector<Ring> rings = outline_rings(raster);
    REQUIRE(rings.size() == 4);
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(rings[k].is_hole == (k % 2 == 1));
      CHECK(rings[k].points.size() <= 16);
    }
    CHECK(std::abs(area_of(rings) - (64 - 36 + 16 - 4)) < 1.5);
    CHECK(doubled_area(rings[0].points) < doubled_area(rings[2].points));
  }
}

TEST_CASE("a line is bent no more than it needs, and nowhere farther off than the tolerance") {
  Random random(5);
  std::vector<Vec2> line;
  for (int i = 0; i <= 200; ++i)
    line.push_back({0.05 * i, std::sin(0.05 * i) + 0.01 * random.uniform(-1, 1)});
  const std::vector<std::size_t> ends = straight_ends(line, 0.05);
  CHECK(ends.front() == 0);
  CHECK(ends.back() == 200);
  CHECK(ends.size() < 20);
  for (std::size_t k = 1; k < ends.size(); ++k)
    for (std::size_t i = ends[k - 1]; i <= ends[k]; ++i)
      CHECK(distance_to(line[i], line[ends[k - 1]], line[ends[k]]) < 0.051);
}

TEST_CASE("nothing has no rings, and single cells are nothing") {
  CHECK(outline_rings({}).empty());
  CHECK(outline_rings(drawn_raster(9, 9, [](const Vec2&) { return false; })).empty());
  Raster dots = drawn_raster(9, 9, [](const Vec2&) { return false; });
  dots.bits[dots.index(2, 2)] = dots.bits[dots.index(6, 6)] = 1;
  CHECK(outline_rings(dots).empty());
}
