// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "segments.h"

#include <set>

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

TEST_CASE("segments are side by side where they are, and as far apart as they are there") {
  const Segment s{{0, 0, 0}, {4, 0, 0}};
  const auto along = side_by_side(s, {{1, 0.3, 0}, {6, 0.3, 0}});
  REQUIRE(along);
  CHECK(along->length == doctest::Approx(3));
  CHECK(along->width == doctest::Approx(0.3));
  CHECK((along->gap - Vec3(0, 0.3, 0)).norm() < 1e-12);
  const auto opening = side_by_side(s, {{3, 0.2, 0}, {1, 0, 0}});
  REQUIRE(opening);
  CHECK(opening->length == doctest::Approx(2));
  CHECK(opening->width == doctest::Approx(0.2));
  CHECK_FALSE(side_by_side(s, {{4.1, 0, 0}, {6, 0, 0}}));
  CHECK_FALSE(side_by_side(s, {{2, 1, 0}, {2, 2, 0}}));  // square to it: beside in a point
}

TEST_CASE("all segments that are near each other are found, and once") {
  Random random(1);
  std::vector<Segment> segments;
  for (int k = 0; k < 300; ++k) {
    const Vec3 from(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(0, 3));
    segments.push_back({from, from + random.uniform(0.001, 4) * random.direction()});
  }
  const double distance = 0.2;
  const auto pairs = near_pairs(segments, distance);
  const std::set<std::pair<std::size_t, std::size_t>> found(pairs.begin(), pairs.end());
  CHECK(found.size() == pairs.size());
  std::size_t near = 0;
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t k = i + 1; k < segments.size(); ++k) {
      bool is_near = false;  // at some of its points
      for (int t = 0; t <= 200 && !is_near; ++t) {
        const Vec3 p = segments[i].from + (segments[i].to - segments[i].from) * (t / 200.0);
        const Vec3 way = segments[k].to - segments[k].from;
        const double s = std::clamp((p - segments[k].from).dot(way) / way.squaredNorm(), 0.0, 1.0);
        is_near = (segments[k].from + s * way - p).norm() < distance;
      }
      if (!is_near) continue;
      ++near;
      CHECK(found.count({i, k}) == 1);
    }
  CHECK(near > 100);
  CHECK(pairs.size() < 300 * 299 / 4);
}
