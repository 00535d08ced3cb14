// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/layers.h"
#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

const Vec3 kRoom(5, 4, 2.7);

// A room, and once more what of it `again` says, moved by `offset`.
PointCloud seen_twice(const std::function<bool(const Vec3&)>& again, const Vec3& offset) {
  PointCloud cloud = room_points(kRoom, 0.025, 0.004);
  for (const Vec3f& p : room_points(kRoom, 0.025, 0.004, 2).points)
    if (again(p.cast<double>())) cloud.points.push_back(p + offset.cast<float>());
  return cloud;
}

Layers layers_of(const Stages& s) {
  return find_layers(s.grid, s.scale, s.settle(), s.options.layers);
}

}  // namespace

TEST_CASE("a wall that is seen twice, a little apart, is one surface and its offset is told") {
  for (const double offset : {0.04, 0.06, 0.08}) {
    CAPTURE(offset);
    const auto at_wall = [](const Vec3& p) { return p.x() < 0.03 && p.y() < 2.5; };
    for (const double side : {-1, 1}) {
      CAPTURE(side);
      Stages s = run_stages(seen_twice(at_wall, {side * offset, 0, 0}));
      const Layers layers = layers_of(s);
      REQUIRE(layers.pairs.size() == 1);
      CHECK(layers.offset == doctest::Approx(offset).epsilon(0.1));
      CHECK(layers.share == doctest::Approx(2.5 * 2.7 / 95).epsilon(0.2));
      s.scale.flatness = allow_drift(s.scale.flatness, layers, s.options.layers);
      CHECK(s.scale.flatness.drift == doctest::Approx(offset).epsilon(0.1));
      const Clustering c = s.confirm();
      check_clustering(s.grid, c);
      CHECK(c.clusters.size() == 6);
    }
  }
}

TEST_CASE("two sides of a thin wall are no layers") {
  for (const double thickness : {0.04, 0.08}) {
    CAPTURE(thickness);
    const auto all = [](const Vec3&) { return true; };
    const Stages s = run_stages(seen_twice(all, {kRoom.x() + thickness, 0, 0}));
    CHECK(layers_of(s).pairs.empty());
  }
}

TEST_CASE("what is before a wall and hides it is no layer of it") {
  PointCloud cloud;
  const auto is_board = [](const Vec3f& p) {
    return p.x() < 0.03F && std::abs(p.y() - 2) < 0.6F && std::abs(p.z() - 1.4F) < 0.4F;
  };
  for (Vec3f p : room_points(kRoom, 0.025, 0.004).points) {
    if (is_board(p)) p.x() += 0.05F;
    cloud.points.push_back(p);
  }
  CHECK(layers_of(run_stages(std::move(cloud))).pairs.empty());
}

TEST_CASE("few layers do not make a scan one that drifts, and change nothing") {
  const Flatness flat{.max_bend = 0.02, .max_sag = 0.002};
  const Flatness few = allow_drift(flat, {.pairs = {{0, 1}}, .offset = 0.06, .share = 0.009});
  CHECK(few.drift == 0);
  CHECK(few.max_bend == flat.max_bend);
  const Flatness many = allow_drift(flat, {.pairs = {{0, 1}}, .offset = 0.06, .share = 0.02});
  CHECK(many.drift == 0.06);
  CHECK(many.limit_at(1) == doctest::Approx(0.024));

  const Stages s = run_stages(seen_twice([](const Vec3& p) { return p.x() < 0.03; }, {0.06, 0, 0}));
  const Clustering settled = s.settle();
  CHECK(join_layers(s.grid, s.scale, settled).label == settled.label);
}
