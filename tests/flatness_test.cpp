// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/flatness.h"

#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

// A floor of 6 x 6 m with waves of this height (rms) and a length of 3 m, raised by `step` from
// x = 3 m on.
PointCloud wavy_floor(double height, double noise, double step = 0) {
  PointCloud cloud;
  Random random(1);
  const double k = 2 * M_PI / 3;
  for (double x = 0; x < 6; x += 0.025)
    for (double y = 0; y < 6; y += 0.025)
      cloud.points.emplace_back(Vec3(x, y,
                                     2 * height * std::sin(k * x) * std::sin(k * y) +
                                         (x < 3 ? 0 : step) + noise * random.gauss())
                                    .cast<float>());
  return cloud;
}

Flatness flatness_of(const Stages& s) {
  return find_flatness(s.grid, s.neighbors, s.scale, s.grow(), s.options);
}

}  // namespace

TEST_CASE("a flat scan does not bend, however much noise it has") {
  for (double noise : {0.002, 0.01, 0.02})
    CHECK(flatness_of(run_stages(room_points({5, 4, 2.7}, 0.03, noise))).bend_at(1) == 0);
}

TEST_CASE("waves of a floor are found, little over short extents and whole over long ones") {
  for (double height : {0.003, 0.006}) {
    CAPTURE(height);
    const Flatness flatness = flatness_of(run_stages(wavy_floor(height, 0.002)));
    CHECK(flatness.bend_at(0.3) < 0.3 * height);
    CHECK(flatness.bend_at(2.4) > 0.4 * height);
    CHECK(flatness.bend_at(2.4) < 1.2 * height);
    for (double extent = 0.1; extent < 20; extent *= 1.3)
      CHECK(flatness.bend_at(extent) <= flatness.bend_at(1.3 * extent));
  }
}

TEST_CASE("a floor with waves is one surface, and one with a step is two") {
  for (double step : {0.0, 0.005, 0.03}) {
    CAPTURE(step);
    Stages s = run_stages(wavy_floor(0.004, 0.002, step));
    s.scale.flatness = flatness_of(s);
    CHECK(s.settle().clusters.size() == (step < 0.01 ? 1 : 2));
  }
}

TEST_CASE("between its samples the bend is read off lines, and it ends at twice the last") {
  const Flatness flatness{.samples = {{0.5, 0.001}, {1, 0.003}}, .max_bend = 0.02, .max_sag = 0.01};
  CHECK(flatness.bend_at(0.25) == doctest::Approx(0.0005));
  CHECK(flatness.bend_at(0.75) == doctest::Approx(0.002));
  CHECK(flatness.bend_at(1.5) == doctest::Approx(0.0045));
  CHECK(flatness.bend_at(100) == doctest::Approx(0.006));
  CHECK(flatness.limit_at(1) == doctest::Approx(0.01));
  CHECK(flatness.limit_at(100) == doctest::Approx(0.02));
  CHECK(Flatness{}.bend_at(1) == 0);
}
