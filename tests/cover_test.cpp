// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "space/cover.h"

#include "support/space.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// A floor of 2 m by 2 m that ends at x = 2, where a wall of half its length stands on it.
SpaceStages floor_with_half_wall() {
  LabelledScan scan;
  scan.add({0, 0, 0}, {2, 0, 0}, {0, 2, 0});
  scan.add({2, 0, 0}, {0, 1, 0}, {0, 0, 1.5});
  return run_space(scan);
}

// The value of a cover's cells at a place.
double value_at(const space::Cover& cover, const std::vector<float>& values, const Vec3& place) {
  const auto at = cover.supported.find(cover.frame.to_plane(place));
  REQUIRE(at);
  return static_cast<double>(values[*at]);
}

const space::Cover& cover_at(const SpaceStages& stages, const Vec3& place, const Vec3& normal) {
  return stages.outlook.covers[patch_at(stages.patches, place, normal)];
}

}  // namespace

TEST_CASE("what has points is at distance 0, and all else farther the farther it is") {
  const SpaceStages stages = run_space(seen_from(table_room_sides(), {kScanner}));
  for (const space::Cover& cover : stages.outlook.covers) {
    const surface::Raster& raster = cover.supported;
    if (cover.is_none()) continue;
    REQUIRE(cover.distance.size() == raster.bits.size());
    REQUIRE(cover.empty.size() == raster.bits.size());
    std::size_t count = 0, wrong = 0, steep = 0;
    const auto slant = static_cast<float>(1.42 * raster.cell);
    for (int y = 0; y < raster.height; ++y)
      for (int x = 0; x < raster.width; ++x) {
        const std::size_t i = raster.index(x, y);
        count += raster.bits[i];
        wrong += (raster.bits[i] != 0) != (cover.distance[i] == 0);
        wrong += raster.bits[i] && cover.empty[i] != 0;
        wrong += !(cover.empty[i] >= 0 && cover.empty[i] <= 1);
        // No neighbour is farther than by a step, but where a way is blocked or ends.
        if (x + 1 == raster.width || cover.distance[i + 1] >= space::Cover::kBlocked) continue;
        steep += cover.distance[i] < cover.distance[i + 1] - slant &&
                 cover.distance[i] < static_cast<float>(cover.reach) && cover.distance[i] == 0;
      }
    CHECK(wrong == 0);
    CHECK(steep == 0);
    CHECK(cover.area ==
          doctest::Approx(static_cast<double>(count) * raster.cell * raster.cell).epsilon(1e-9));
    const bool is_floor = cover.area > 4 && cover.plane.normal.z() > 0.9;
    CHECK(cover.reach ==
          doctest::Approx(std::clamp(0.7 * std::sqrt(cover.area), 0.3, is_floor ? 4 : 0.8)));
  }
}

TEST_CASE(
    "a plane goes on beside a wall that stands on it, and behind the wall only around its end") {
  const SpaceStages stages = floor_with_half_wall();
  const space::Cover& floor = stages.outlook.covers[0];
  const double cell = floor.supported.cell;
  for (double off = 0.1; off < 0.6; off += 0.1) {
    for (double y = 1.2; y < 1.9; y += 0.1)
      CHECK(value_at(floor, floor.distance, {2 + off, y, 0}) ==
            doctest::Approx(off).epsilon(2 * cell));
    for (double y = 0.3; y < 0.8; y += 0.1) {
      // From the ends of the wall at (2, 0) and (2, 1), though points are nearer.
      const double around = std::hypot(off, std::min(y, 1 - y));
      CHECK(value_at(floor, floor.distance, {2 + off, y, 0}) > around - 2 * cell);
    }
  }
}

TEST_CASE("a floor goes on far under a ceiling, and not under the sky") {
  LabelledScan scan;
  scan.add({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  CHECK(run_space(scan).outlook.covers[0].reach == doctest::Approx(0.8));
  scan.add({0, 0, 2.5}, {0, 4, 0}, {4, 0, 0});
  const SpaceStages stages = run_space(scan);
  const space::Cover& floor = cover_at(stages, {2, 2, 0}, Vec3::UnitZ());
  CHECK(floor.reach == doctest::Approx(2.8).epsilon(0.02));
  CHECK(value_at(floor, floor.distance, {6, 2, 0}) == doctest::Approx(2).epsilon(0.05));
}

TEST_CASE("a plane that stands off the end of another one blocks nothing") {
  LabelledScan scan;
  scan.add({0, 0, 0}, {2, 0, 0}, {0, 2, 0});
  scan.add({2, 0, 0.6}, {0, 1, 0}, {0, 0, 1.5});  // starts too high to be met
  const SpaceStages stages = run_space(scan);
  const space::Cover& floor = stages.outlook.covers[0];
  CHECK(value_at(floor, floor.distance, {2.3, 0.5, 0}) == doctest::Approx(0.3).epsilon(0.2));
}

TEST_CASE("emptiness is near 1 where points should be and are not, and 0 in shadows") {
  // A pit in full view, the shadow of the table, and what is below the field of view.
  LabelledScan scan = seen_from(table_room_sides(), {kScanner});
  const Box3 pit(Vec3(1.9, 2.1, -0.1), Vec3(2.6, 2.8, 0.1));
  LabelledScan rest = scan;
  rest.cloud.points.clear(), rest.cloud.viewers.clear(), rest.labels.clear();
  for (std::size_t i = 0; i < scan.cloud.points.size(); ++i) {
    if (pit.contains(scan.cloud.points[i].cast<double>())) continue;
    rest.cloud.points.push_back(scan.cloud.points[i]);
    rest.cloud.viewers.push_back(scan.cloud.viewers[i]), rest.labels.push_back(scan.labels[i]);
  }
  const SpaceStages stages = run_space(rest);
  const space::Cover& floor = cover_at(stages, {0.2, 0.2, 0}, Vec3::UnitZ());
  for (double a = 0.1; a <= 0.6; a += 0.1)
    for (double b = 0.1; b <= 0.6; b += 0.1) {
      CHECK(value_at(floor, floor.empty, pit.min() + Vec3(a, b, 0.1)) > 0.8);
      CHECK(value_at(floor, floor.empty, Vec3(3.15 + a, 0.9 + b, 0)) == 0);  // behind the table
      CHECK(value_at(floor, floor.empty, kScanner + Vec3(a - 0.35, b - 0.35, -1.5)) == 0);
    }
}

TEST_CASE("points stand for a cell each where they are dense, for more where they are sparse") {
  LabelledScan scan;
  scan.add({0, 0, 0}, {2, 0, 0}, {0, 2, 0});
  Random random(3);
  const int sparse = static_cast<int>(scan.planes.size());
  scan.planes.push_back(plane_through({5, 0, 0}, Vec3::UnitZ()));
  add_rectangle(scan.cloud, {5, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.1, 0, random);
  scan.labels.resize(scan.cloud.points.size(), sparse);
  const SpaceStages stages = run_space(scan);
  const space::Cover &dense = stages.outlook.covers[0], &thin = stages.outlook.covers[1];
  const double cell = dense.supported.cell * dense.supported.cell;
  CHECK(dense.area_of_point({1, 1, 0}) == doctest::Approx(cell).epsilon(0.05));
  CHECK(dense.area_of_point({9, 1, 0}) == 0);
  double most = 0;
  for (const Vec3f& p : scan.cloud.points)
    if (p.x() > 5.5F && p.x() < 6.5F) most = std::max(most, thin.area_of_point(p.cast<double>()));
  CHECK(most > 2 * cell);
}
