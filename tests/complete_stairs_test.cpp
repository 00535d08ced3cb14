// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/complete_stairs.h"

#include <algorithm>

#include "support/scenes.h"
#include "turn.h"
#include "world/level.h"
#include "world/validate.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

constexpr double kRiser = 0.17, kTread = 0.28;

// A floor, eight risers, and a floor above; without some of the treads, counted from 1.
World flight_without(const std::vector<int>& missing) {
  std::vector<FoundSurface> surfaces = {level_rectangle(-3, -2, 5, 4, 0)};
  for (int k = 1; k < 8; ++k)
    if (std::find(missing.begin(), missing.end(), k) == missing.end())
      surfaces.push_back(level_rectangle(1 + (k - 1) * kTread, 0, 1 + k * kTread, 1, k * kRiser));
  surfaces.push_back(level_rectangle(1 + 7 * kTread, -2, 6, 4, 8 * kRiser));
  return world_with(surfaces);
}

Vec3 middle_of_tread(int k) { return {1 + (k - 0.5) * kTread, 0.5, k * kRiser}; }

int count_at(const World& world, const Vec3& place, Kind kind) {
  return static_cast<int>(
      std::count_if(world.surfaces.begin(), world.surfaces.end(), [&](const Surface& s) {
        return s.kind == kind && (centroid(world, s) - place).norm() < 0.02;
      }));
}

}  // namespace

TEST_CASE("treads that nothing was seen of are added, and the risers before and behind them") {
  const World before = flight_without({3, 4});
  const World after = complete_stairs(before, {});
  REQUIRE(validate(after).empty());
  CHECK(after.surfaces.size() == before.surfaces.size() + 2 + 3);
  for (const int k : {3, 4}) CHECK(count_at(after, middle_of_tread(k), Kind::floor) == 1);
  for (const int k : {3, 4, 5})
    CHECK(count_at(after, {1 + (k - 1) * kTread, 0.5, (k - 0.5) * kRiser}, Kind::other) == 1);
  for (std::size_t i = before.surfaces.size(); i < after.surfaces.size(); ++i) {
    CHECK(after.surfaces[i].source == Source::inferred);
    CHECK(after.surfaces[i].thickness == doctest::Approx(kRiser / 2).epsilon(0.01));
  }
  CHECK(complete_stairs(after, {}).surfaces.size() == after.surfaces.size());
}

TEST_CASE("treads are added in a tilted world too") {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.3, Vec3(1, 2, 0.5).normalized()));
  const World after = complete_stairs(moved(flight_without({5}), turn, {1, 2, 3}), {});
  CHECK(count_at(after, turn * middle_of_tread(5) + Vec3(1, 2, 3), Kind::floor) == 1);
}

TEST_CASE("whole stairs stay as they are") {
  const World world = flight_without({});
  CHECK(complete_stairs(world, {}) == world);
}

TEST_CASE("a tread that lines of sight go through is not added") {
  std::vector<SightLine> lines;
  for (int k = 0; k < 20; ++k)
    lines.push_back({middle_of_tread(3) + Vec3(0.005 * k, 0.01 * k, 1),
                     middle_of_tread(3) + Vec3(0.005 * k, 0.01 * k, -0.3)});
  const World world = flight_without({3});
  CHECK(complete_stairs(world, lines).surfaces.size() == world.surfaces.size());
}

TEST_CASE("of a tread that was seen in part the rest is added, as high as that part") {
  std::vector<FoundSurface> surfaces = {level_rectangle(-3, -2, 5, 4, 0)};
  for (int k = 1; k < 8; ++k)
    surfaces.push_back(level_rectangle(1 + (k - 1) * kTread, k == 3 ? 0.5 : 0, 1 + k * kTread, 1,
                                       k * kRiser + (k == 3 ? 0.01 : 0)));
  surfaces.push_back(level_rectangle(1 + 7 * kTread, -2, 6, 4, 8 * kRiser));
  const World after = complete_stairs(world_with(surfaces), {});
  CHECK(count_at(after, middle_of_tread(3) + Vec3(0, -0.25, 0.01), Kind::floor) == 1);
}
