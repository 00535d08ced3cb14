// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "viewer/packed_points.h"

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

TEST_CASE("packed points come back within half a step of their box") {
  Random random(3);
  const Box3 box(Vec3(-3, 10, 0), Vec3(40, 11, 0));  // flat
  std::vector<Vec3> points;
  for (int i = 0; i < 1000; ++i)
    points.push_back({random.uniform(-3, 40), random.uniform(10, 11), 0});
  const std::vector<std::uint16_t> packed = pack(points, box);
  REQUIRE(packed.size() == 3000);
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const int axis = static_cast<int>(i % 3);
    const double back = box.min()[axis] + box.sizes()[axis] * packed[i] / 65535;
    CHECK(std::abs(back - points[i / 3][axis]) <= box.sizes()[axis] / 65535 / 2 + 1e-9);
  }
}

TEST_CASE("points outside of the box are put on its border") {
  const Box3 box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  CHECK(pack({{-5, 0.5, 9}}, box) == std::vector<std::uint16_t>{0, 32768, 65535});
}
