// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/patch.h"

#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

TEST_CASE("points are grouped by their planes, those of none left out") {
  const std::vector<std::int32_t> labels = {2, -1, 0, 2, 0, -1, 2};
  const Members members = group_points(labels, 4);
  const auto of = [&](std::size_t plane) {
    return std::vector<std::uint32_t>(members.of(plane).begin(), members.of(plane).end());
  };
  CHECK(of(0) == std::vector<std::uint32_t>{2, 4});
  CHECK(of(1).empty());
  CHECK(of(2) == std::vector<std::uint32_t>{0, 3, 6});
  CHECK(of(3).empty());
}

TEST_CASE("cells have evidence for the surface where points are, against it where they end") {
  LabelledScan scan;
  scan.add({0, 0, 0}, {2, 0, 0}, {0, 1, 0});
  const Patch patch = scan.patches()[0];
  CHECK(evidence_at(patch, {1, 0.5, 0}) >= 1);
  CHECK(evidence_at(patch, {2.15, 0.5, 0}) < -0.5);
  CHECK(patch.covered.is_set(patch.frame.to_plane({1, 0.5, 0})));
  CHECK_FALSE(patch.covered.is_set(patch.frame.to_plane({2.15, 0.5, 0})));
}

TEST_CASE("what is sparse is no less there: its gaps say little") {
  LabelledScan scan;
  scan.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    scan.cloud.points.emplace_back(static_cast<float>(random.uniform(1, 3)),
                                   static_cast<float>(random.uniform(0, 1)), 0.f);
    scan.labels.push_back(0);
  }
  const Patch patch = scan.patches()[0];
  double dense = 0, sparse = 0;
  for (std::size_t i = 0; i < patch.evidence.size(); ++i) {
    const Vec3 p = patch.frame.to_space(patch.middle[i]);
    if (p.y() < 0 || p.y() > 1 || p.x() < 0 || p.x() > 3) continue;
    (p.x() < 1 ? dense : sparse) += static_cast<double>(patch.evidence[i]);
  }
  CHECK(dense > 0);
  CHECK(sparse > 0);
}
