// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "viewers.h"

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

TEST_CASE("the main viewer is that of most points, of equal ones the nearest, in any order") {
  const std::vector<Vec3> viewpoints = {{9, 0, 0}, {1, 0, 0}, {4, 0, 0}};
  const auto main_of = [&](std::vector<std::int32_t> viewers) {
    return main_viewer(viewers, viewpoints, Vec3::Zero());
  };
  CHECK(main_of({}) == -1);
  CHECK(main_of({-1, -1}) == -1);
  CHECK(main_of({-1, -1, -1, 0}) == 0);
  CHECK(main_of({1, 0, 0}) == 0);
  Random random(5);
  std::vector<std::int32_t> tie = {2, 2, 0, 0, -1, -1, 1};
  for (int round = 0; round < 20; ++round) {
    shuffle(tie, random);
    CHECK(main_of(tie) == 2);
  }
}
