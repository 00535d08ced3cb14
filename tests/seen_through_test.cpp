// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/seen_through.h"

#include <algorithm>

#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

namespace {

// A wall in y = 0 with a gap from x = 1 to 2 that something stands before, and a wall 2 m behind.
LabelledScan hidden_gap() {
  LabelledScan scan;
  const int wall = scan.add({0, 0, 0}, {0, 0, 2.5}, {1, 0, 0});
  scan.add({2, 0, 0}, {0, 0, 2.5}, {1, 0, 0}, wall);
  scan.add({1, 0, 2}, {0, 0, 0.5}, {1, 0, 0}, wall);
  scan.add({0, -2, 0}, {0, 0, 2.5}, {3, 0, 0});
  scan.add({1, 0.3, 0}, {0, 0, 1}, {1, 0, 0});
  return scan;
}

}  // namespace

TEST_CASE("what lines of sight go through is seen through, also where clutter stands before it") {
  LabelledScan scan = hidden_gap();
  scan.cloud.viewpoints = {Vec3(1.5, 3, 1.5)};
  const Patch wall = scan.patches()[0];
  const Raster through = seen_through(wall, scan.surroundings());
  const auto at = [&](const Vec3& p) { return through.is_set(wall.frame.to_plane(p)); };
  CHECK(at({1.5, 0, 1.5}));
  CHECK(at({1.2, 0, 1.2}));
  CHECK_FALSE(at({1.5, 0, 2.6}));  // over all that is behind
  CHECK(evidence_at(scan.weighed_patches()[0], {1.5, 0, 1.5}) == -1);
}

TEST_CASE("a place that two viewpoints may have seen proves nothing, nor do unknown ones") {
  LabelledScan scan = hidden_gap();
  const Patch wall = scan.patches()[0];
  for (const auto& viewpoints :
       {std::vector<Vec3>{}, std::vector<Vec3>{{1.5, 3, 1.5}, {1.5, -1, 1.5}}}) {
    scan.cloud.viewpoints = viewpoints;
    const Raster through = seen_through(wall, scan.surroundings());
    CHECK(std::count(through.bits.begin(), through.bits.end(), 1) == 0);
  }
}

TEST_CASE("a place that knows its viewpoint proves a gap, where two may have seen it") {
  LabelledScan scan = hidden_gap();
  const Patch wall = scan.patches()[0];
  scan.cloud.viewpoints = {{1.5, 3, 1.5}, {1.5, -1, 1.5}};
  const auto is_through = [&](std::int32_t viewer) {
    scan.cloud.viewers.assign(scan.cloud.points.size(), viewer);
    return seen_through(wall, scan.surroundings()).is_set(wall.frame.to_plane({1.5, 0, 1.5}));
  };
  CHECK(is_through(0));
  CHECK_FALSE(is_through(1));
  CHECK_FALSE(is_through(-1));
}

TEST_CASE("of viewpoints in different rooms the one in the room has seen a place") {
  LabelledScan scan;
  scan.add({0, 0, 0}, {0, 0, 2.5}, {3, 0, 0});
  scan.add({0, 2, 0}, {0, 0, 2.5}, {3, 0, 0});
  scan.add({0, -2, 0}, {0, 0, 2.5}, {3, 0, 0});
  scan.cloud.viewpoints = {Vec3(1.5, 1, 1), Vec3(1.5, -1, 1)};
  const Surroundings around = scan.surroundings();
  for (std::size_t i = 0; i < around.points.size(); ++i)
    if (around.planes[i] > 0) CHECK(around.viewers[i] == (around.points[i].y() > 0 ? 0 : 1));
}
