// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/bridge.h"

#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

// Two walls in one plane with a gap between them, the second set back by `step` and turned by
// `slope`; in the middle of the gap a wall that crosses, where asked for.
struct Scene {
  double gap = 0.2, step = 0, slope = 0;
  bool crossing = false;
  double crossing_height = 2;
  double screen = 0;  // [m] from the wall to what stands before the gap; 0 = nothing does
};

Stages gap_stages(const Scene& scene) {
  PointCloud cloud;
  Random random(1);
  add_rectangle(cloud, {-1.5 - scene.gap / 2, 0, 0}, {1.5, 0, 0}, {0, 0, 2}, 0.02, 0.004, random);
  add_rectangle(cloud, {scene.gap / 2, scene.step, 0}, {1.5, 1.5 * scene.slope, 0}, {0, 0, 2}, 0.02,
                0.004, random);
  if (scene.crossing)
    add_rectangle(cloud, {0, -1, 0}, {0, 2, 0}, {0, 0, scene.crossing_height}, 0.02, 0.004, random);
  if (scene.screen > 0)
    add_rectangle(cloud, {-0.3, -scene.screen, 0}, {0.6, 0, 0}, {0, 0, 2}, 0.02, 0.004, random);
  return run_stages(std::move(cloud), known_scale(0.004, 0.02));
}

Clustering walls_of(const Stages& s, const Scene& scene) {
  return label_sites(s.grid, [&](const Vec3& p) {
    if (scene.screen > 0 && std::abs(p.y() + scene.screen) < 0.05) return scene.crossing ? 3 : 2;
    return std::abs(p.x()) < std::max(scene.gap / 2 - 0.03, 0.02) ? 2 : p.x() < 0 ? 0 : 1;
  });
}

std::size_t count_clusters(const Stages& s, const Clustering& c) {
  check_clustering(s.grid, c);
  for (std::size_t i = 0; i < c.label.size(); ++i) CHECK((c.label[i] == kNone) == false);
  return c.clusters.size();
}

std::size_t bridged(const Scene& scene, const BridgeOptions& options = {}) {
  const Stages s = gap_stages(scene);
  return count_clusters(s, bridge_clusters(s.grid, s.scale, walls_of(s, scene), options));
}

// Of the walls, not of what stands before them.
std::size_t joined(Scene scene, const BridgeOptions& options = {}, double screen = 0.5) {
  scene.screen = screen;
  const Stages s = gap_stages(scene);
  return count_clusters(s, bridge_pieces(s.grid, s.scale, walls_of(s, scene), options)) -
         (screen > 0);
}

}  // namespace

TEST_CASE("two pieces of a wall are one across a gap of 20 cm that nothing crosses") {
  CHECK(bridged({}) == 1);
  CHECK(bridged({.gap = 0.28}) == 1);
}

TEST_CASE("a wall that crosses in the gap keeps them two") {
  CHECK(bridged({.crossing = true}) == 3);
}

TEST_CASE("what crosses but a small part of the gap does not") {
  CHECK(bridged({.crossing = true, .crossing_height = 0.7}) == 2);
  CHECK(bridged({.crossing = true, .crossing_height = 0.7}, {.open_share = 0.9}) == 3);
}

TEST_CASE("walls that are farther apart, or not in one plane, stay two") {
  CHECK(bridged({.gap = 0.5}) == 2);
  CHECK(bridged({.gap = 0.28}, {.max_gap = 4}) == 2);
  CHECK(bridged({.step = 0.03}) == 2);
  CHECK(bridged({.step = 0.03}, {.max_rms = 5}) == 1);
}

TEST_CASE("many pieces in a row become one") {
  PointCloud cloud;
  Random random(2);
  for (int i = 0; i < 6; ++i)
    add_rectangle(cloud, {0.7 * i, 0, 0}, {0.5, 0, 0}, {0, 0, 1}, 0.02, 0.004, random);
  const Stages s = run_stages(std::move(cloud), known_scale(0.004, 0.02));
  const auto piece = [](const Vec3& p) { return static_cast<std::int32_t>((p.x() + 0.1) / 0.7); };
  const Clustering c = bridge_clusters(s.grid, s.scale, label_sites(s.grid, piece));
  check_clustering(s.grid, c);
  CHECK(c.clusters.size() == 1);
}

TEST_CASE("pieces that go on into each other are one, though no plane in common serves both") {
  const Scene bent{.gap = 0.3, .slope = 0.03};
  CHECK(bridged(bent) == 2);
  CHECK(joined(bent) == 1);
  CHECK(joined({.gap = 0.38}) == 1);
}

TEST_CASE("pieces with a step, at an angle or far apart stay two") {
  CHECK(joined({.gap = 0.3, .step = 0.01}) == 2);
  CHECK(joined({.gap = 0.3, .step = 0.01}, {.max_step = 0.02}) == 1);
  CHECK(joined({.gap = 0.3, .slope = 0.06}) == 2);
  CHECK(joined({.gap = 0.6}) == 2);
}

TEST_CASE("pieces with a gap that nothing hides stay two, as those of a fence do") {
  CHECK(joined({.gap = 0.3}, {}, 0) == 2);
  CHECK(joined({.gap = 0.3}, {}, 1.5) == 2);
}

TEST_CASE("in noise of more than a step pieces stay two") {
  CHECK(joined({.gap = 0.3}, {.max_step = 0.0025}) == 2);
}

TEST_CASE("a wall that crosses between pieces keeps them two, even where they nearly touch") {
  CHECK(joined({.gap = 0.3, .crossing = true}) == 3);
  CHECK(joined({.gap = 0.08, .crossing = true}) == 3);
  CHECK(joined({.gap = 0.3, .crossing = true, .crossing_height = 0.7}) == 2);
}
