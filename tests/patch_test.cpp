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

TEST_CASE("scan lines far apart cover what is between them, a narrow strip nothing beside it") {
  const auto patch_of = [](int lines, double apart) {
    LabelledScan scan;
    scan.planes.push_back({Vec3::UnitZ(), 0});
    for (int k = 0; k < lines; ++k)
      for (int i = 0; i < 400; ++i)
        scan.cloud.points.push_back(Vec3(0.005 * i, 0.01 + apart * k, 0).cast<float>());
    scan.labels.assign(scan.cloud.points.size(), 0);
    return find_patches(scan.cloud, scan.members(), scan.planes, 0.04)[0];
  };
  for (const double apart : {0.12, 0.2, 0.3}) {
    const int lines = 6;
    const Patch patch = patch_of(lines, apart);
    double sum = 0;  // [m2]
    for (std::size_t i = 0; i < patch.evidence.size(); ++i) {
      const Vec3 p = patch.frame.to_space(patch.middle[i]);
      if (p.x() > 0 && p.x() < 2 && p.y() > 0 && p.y() < (lines - 1) * apart)
        sum += static_cast<double>(patch.evidence[i]) * patch.hit.cell * patch.hit.cell;
    }
    CHECK(sum > 0.6 * 2 * (lines - 1) * apart);
  }
  CHECK(patch_of(1, 0).hit.cell == 0.04);
  CHECK(patch_of(40, 0.005).hit.cell == 0.04);
}
