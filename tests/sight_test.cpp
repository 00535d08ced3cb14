// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "space/sight.h"

#include "support/space.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// Also where no viewpoint is known.
space::Sight sight_of(const LabelledScan& scan, const space::SightOptions& options = {},
                      const Vec3& up = Vec3::UnitZ()) {
  surface::Surroundings around = surface::surroundings_of(scan.cloud.points, scan.labels);
  around.viewpoints = scan.cloud.viewpoints;
  return {around, scan.cloud.viewers, 0.02, options, up};
}

// Places of the floor every 10 cm, a cell off the walls.
template <typename Visit>
void visit_floor(const Visit& visit) {
  for (double x = 0.2; x < kRoomSize.x() - 0.15; x += 0.1)
    for (double y = 0.2; y < kRoomSize.y() - 0.15; y += 0.1) visit(Vec3(x, y, 0));
}

// Where the line from the scanner to a place passes the height of the table top.
Vec2 shadow_at(const Vec3& place) {
  const double t = (kTableTop.max().z() - place.z()) / (kScanner.z() - place.z());
  return (place + t * (kScanner - place)).head<2>();
}

double off_table(const Vec2& p) {
  const Vec2 low = kTableTop.min().head<2>(), high = kTableTop.max().head<2>();
  return (p.cwiseMax(low).cwiseMin(high) - p).norm();
}

double inside_table(const Vec2& p) {
  return std::min((p - kTableTop.min().head<2>()).minCoeff(),
                  (kTableTop.max().head<2>() - p).minCoeff());
}

}  // namespace

TEST_CASE(
    "the floor is exposed where a scanner sees it, not under a table nor below its field of view") {
  const space::Sight sight = sight_of(seen_from(table_room_sides(), {kScanner}));
  int open = 0, shadow = 0, blind = 0;
  visit_floor([&](const Vec3& p) {
    const Vec3 way = p - kScanner;
    const double elevation = std::asin(way.z() / way.norm());
    const bool is_exposed = sight.is_exposed(p, Vec3::UnitZ());
    if (elevation < kLowestSeen - 4 * kDegree) {
      CHECK_FALSE(is_exposed), ++blind;
    } else if (inside_table(shadow_at(p)) > 0.15) {
      CHECK_FALSE(is_exposed), ++shadow;
    } else if (elevation > kLowestSeen + 4 * kDegree && off_table(shadow_at(p)) > 0.25) {
      CHECK(is_exposed), ++open;
    }
  });
  CHECK(open > 300);
  CHECK(shadow > 50);
  CHECK(blind > 50);
}

TEST_CASE("a floor that looks down is not exposed, nor one that is seen too much aslant") {
  const LabelledScan scan = seen_from(room_sides(), {kScanner});
  const space::Sight sight = sight_of(scan), strict = sight_of(scan, {.min_cosine = 0.9});
  const Vec3 place(2.5, 1.5, 0);
  CHECK(sight.is_exposed(place, Vec3::UnitZ()));
  CHECK_FALSE(sight.is_exposed(place, -Vec3::UnitZ()));
  CHECK_FALSE(strict.is_exposed(place, Vec3::UnitZ()));
}

TEST_CASE("what one scanner does not see another one may") {
  const Vec3 other(3.6, 1.4, 0.4);
  const std::vector<RoomSide> sides = table_room_sides();
  const space::Sight one = sight_of(seen_from(sides, {kScanner})),
                     both = sight_of(seen_from(sides, {kScanner, other})),
                     nearest = sight_of(seen_from(sides, {kScanner, other}), {.viewers = 1});
  const Vec3 under(2.8, 1.4, 0), open(0.3, 1.5, 0);
  CHECK_FALSE(one.is_exposed(under, Vec3::UnitZ()));
  CHECK(both.is_exposed(under, Vec3::UnitZ()));
  CHECK(nearest.is_exposed(under, Vec3::UnitZ()));
  // The nearest viewpoint alone is asked, though a farther one sees more.
  CHECK(both.is_exposed(open, Vec3::UnitZ()));
}

TEST_CASE("a viewpoint that saw nothing exposes nothing") {
  LabelledScan scan = seen_from(room_sides(), {kScanner});
  const Vec3 place(2.5, 1.5, 0);
  CHECK(sight_of(scan).is_exposed(place, Vec3::UnitZ()));
  std::fill(scan.cloud.viewers.begin(), scan.cloud.viewers.end(), -1);
  CHECK_FALSE(sight_of(scan).is_exposed(place, Vec3::UnitZ()));
}

TEST_CASE("where no viewpoint is known, what stands close before a plane hides it") {
  LabelledScan scan = seen_from(table_room_sides(), {kScanner});
  scan.cloud.viewpoints.clear(), scan.cloud.viewers.assign(scan.cloud.points.size(), -1);
  for (const double ahead : {0.4, 0.9}) {
    const space::Sight sight = sight_of(scan, {.look_ahead = ahead}, Vec3::UnitX());
    CHECK(sight.is_exposed({2.6, 1.4, 0}, Vec3::UnitZ()) == (ahead < kTableTop.min().z()));
    CHECK(sight.is_exposed({1, 0.5, 0}, Vec3::UnitZ()));
  }
}

TEST_CASE("where no viewpoint is known, a floor is none only where something is below") {
  LabelledScan scan;
  scan.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  scan.add({2, 0, -2}, {1, 0, 0}, {0, 1, 0});
  const space::Sight sight = sight_of(scan);
  CHECK_FALSE(sight.is_exposed({1.5, 0.5, 0}, Vec3::UnitZ()));
  CHECK(sight.is_exposed({2.5, 0.5, 0}, Vec3::UnitZ()));
  CHECK(sight.is_exposed({1.5, 0.5, 0}, Vec3::UnitX()));  // a wall
  CHECK_FALSE(sight_of(scan, {.look_below = 1}).is_exposed({2.5, 0.5, 0}, Vec3::UnitZ()));
}

TEST_CASE("points of planes fill their cells, single flying ones fill none") {
  LabelledScan scan;
  scan.cloud = cloud_of({{0.05, 0.05, 0.05},
                         {1.05, 0.05, 0.05},
                         {1.06, 0.05, 0.05},
                         {2.05, 0.05, 0.05},
                         {2.06, 0.05, 0.05},
                         {2.07, 0.05, 0.05}});
  scan.labels = {0, -1, -1, -1, -1, -1};
  scan.cloud.viewers.assign(6, -1);
  const space::Sight sight = sight_of(scan);
  CHECK(sight.cell() == doctest::Approx(0.1));
  CHECK(sight.is_occupied({0.01, 0.09, 0.05}));
  CHECK_FALSE(sight.is_occupied({1.05, 0.05, 0.05}));
  CHECK(sight.is_occupied({2.05, 0.05, 0.05}));
  CHECK_FALSE(sight.is_occupied({0.05, 0.05, 0.15}));
}
