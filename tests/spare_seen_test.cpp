// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/spare_seen.h"

#include <algorithm>

#include "cell_walk.h"
#include "support/clutter.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

constexpr double kCell = 0.06;

// The four sides of a bar along one of the axes.
void add_bar(std::vector<Vec3>& points, const Vec3& low, const Vec3& high) {
  const Vec3 size = high - low;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (double a = 0; a <= size[u]; a += 0.02)
      for (double b = 0; b <= size[v]; b += 0.02)
        for (double end : {0.0, size[axis]}) {
          Vec3 p = low;
          p[axis] += end, p[u] += a, p[v] += b;
          points.push_back(p);
        }
  }
}

// The front of a rack: three uprights and three beams, 10 cm thick.
std::vector<Vec3> rack() {
  std::vector<Vec3> points;
  for (double x : {0.0, 2.0, 4.0}) add_bar(points, {x, 0, 0}, {x + 0.1, 0.1, 3});
  for (double z : {0.5, 1.5, 2.5}) add_bar(points, {0, 0, z}, {4, 0.1, z + 0.1});
  return points;
}

// An L of two banks, 10 cm thick and 1 m high.
std::vector<Vec3> ell() {
  std::vector<Vec3> points;
  add_bar(points, {0, 0, 0}, {2, 0.1, 1});
  add_bar(points, {0, 0, 0}, {0.1, 2, 1});
  return points;
}

double nearest_outside_boxes(const std::vector<OrientedBox>& boxes, const Vec3& p) {
  double least = 1e300;
  for (const OrientedBox& box : boxes)
    least = std::min(least, outside_of(Obstacle{.shape = box}, {}, p));
  return least;
}

std::vector<OrientedBox> cover(const std::vector<Vec3>& points) {
  return cover_by_boxes(points, Vec3::UnitZ(), kCell, 0.005);
}

SeenSpace seen_in(const Box3& box) {
  SeenSpace seen{kCell, {}, true};
  const auto at = [](const Vec3& p) {
    return Vec3((p / kCell).array().round()).cast<int>().eval();
  };
  const Eigen::Vector3i low = at(box.min()), high = at(box.max());
  for (int x = low.x(); x < high.x(); ++x)
    for (int y = low.y(); y < high.y(); ++y)
      for (int z = low.z(); z < high.z(); ++z) seen.through.insert(morton_of({x, y, z}));
  return seen;
}

SeenSpace nothing_seen() { return {kCell, {}, true}; }

}  // namespace

TEST_CASE("boxes hold all points of a rack or an L, and none of the air between") {
  for (const auto& points : {rack(), ell()}) {
    const auto boxes = cover(points);
    for (const Vec3& p : points) CHECK(nearest_outside_boxes(boxes, p) <= kCell / 2 + 1e-9);
    // No box is fatter than what its points lie on, by more than cells that hold few of them.
    for (const OrientedBox& box : boxes) CHECK(box.size.minCoeff() <= 0.1 + kCell);
  }
  const auto of_rack = cover(rack()), of_ell = cover(ell());
  for (double x = 0.25; x < 1.9; x += 0.15) {
    for (double z = 0.8; z < 1.4; z += 0.15)
      CHECK(nearest_outside_boxes(of_rack, {x, 0.05, z}) > 0);
    CHECK(nearest_outside_boxes(of_ell, {x, 0.3, 0.5}) > 0);
  }
}

TEST_CASE("boxes go over crossings, so that a rack has few") {
  CHECK(cover(rack()).size() <= 12);
  CHECK(cover(ell()).size() <= 8);
}

TEST_CASE("boxes do not depend on the order of points") {
  std::vector<Vec3> points = rack();
  const auto boxes = cover(points);
  std::reverse(points.begin(), points.end());
  const auto again = cover(points);
  REQUIRE(again.size() == boxes.size());
  for (std::size_t k = 0; k < boxes.size(); ++k)
    CHECK((again[k].center - boxes[k].center).norm() < 1e-9);
}

TEST_CASE("a single point and points in a line are covered too") {
  CHECK(cover({{1, 2, 3}}).size() <= 1);
  std::vector<Vec3> line;
  for (double x = 0; x < 1; x += 0.02) line.emplace_back(x, 0.3, 0.2);
  const auto boxes = cover(line);
  REQUIRE(boxes.size() == 1);
  CHECK(boxes[0].size.maxCoeff() == doctest::Approx(0.98));
  CHECK(boxes[0].size.minCoeff() > 0);
}

TEST_CASE("a hull is kept until what it holds was seen") {
  const std::vector<Vec3> points = ell();
  const Solid hull = enclose(points, 0.005);
  CHECK(spares_free(hull, {}, points, nothing_seen()));
  const SeenSpace seen = seen_in(Box3(Vec3(0.3, 0.3, 0.2), Vec3(0.9, 0.9, 0.8)));
  CHECK(free_volume(hull, {}, points, seen) == doctest::Approx(0.216).epsilon(0.2));
  CHECK_FALSE(spares_free(hull, {}, points, seen));
}

TEST_CASE("what is thin is kept where points fill it, seen or not") {
  const std::vector<Vec3> frame = rack();
  CHECK_FALSE(spares_free(enclose(frame, 0.005), {}, frame, nothing_seen()));
  std::vector<Vec3> board;
  add_bar(board, {0, 0, 0}, {2, 0.05, 1});
  CHECK(spares_free(enclose(board, 0.005), {}, board, nothing_seen()));
}

TEST_CASE("without viewpoints a hull with many points deep in it is none") {
  std::vector<Vec3> shelf;
  for (double z : {0.0, 0.5, 1.0, 1.5, 2.0}) add_bar(shelf, {0, 0, z}, {2, 1, z + 0.05});
  std::vector<Vec3> crate;
  add_bar(crate, {0, 0, 0}, {2, 1, 2});
  const SeenSpace unknown{kCell, {}, false};
  CHECK_FALSE(spares_free(enclose(shelf, 0.005), {}, shelf, unknown));
  CHECK(spares_free(enclose(crate, 0.005), {}, crate, unknown));
}
