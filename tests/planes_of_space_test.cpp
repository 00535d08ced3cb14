// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "space/planes_of_space.h"

#include "support/space.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

using PlaneKind = space::SpacePlane::Kind;

std::vector<space::SpacePlane> planes_of_kind(const std::vector<space::SpacePlane>& planes,
                                              PlaneKind kind) {
  std::vector<space::SpacePlane> those;
  for (const space::SpacePlane& p : planes)
    if (p.kind == kind) those.push_back(p);
  return those;
}

// A wall of which the right half stands back.
SpaceStages stepped_wall(double step) {
  return run_space(
      seen_from({{{0, 0, 0}, {1.5, 0, 0}, {0, 0, 2}}, {{1.5, -step, 0}, {1.5, 0, 0}, {0, 0, 2}}},
                {{1.5, 2, 1}}, -90 * kDegree));
}

// Two boards before a wall.
SpaceStages two_boards() {
  return run_space(seen_from({{{-1, -1, -1}, {5, 0, 0}, {0, 0, 5}},
                              {{0, 0, 0}, {1, 0, 0}, {0, 0, 2}},
                              {{2, 0, 0}, {1, 0, 0}, {0, 0, 2}}},
                             {{1.5, 3, 1}}, -90 * kDegree));
}

// Where the doc of planes_of_space() and SpacePlane::is_late put a plane.
int turn_in(const space::SpacePlane& p) {
  if (p.kind == PlaneKind::step) return 1;
  if (p.kind != PlaneKind::surface) return 4;
  return p.is_late ? 2 : p.size > 0.5 ? 0 : 3;
}

void check_order(const std::vector<space::SpacePlane>& planes) {
  for (std::size_t i = 1; i < planes.size(); ++i) {
    const int before = turn_in(planes[i - 1]), own = turn_in(planes[i]);
    CHECK(before <= own);
    if (before == own) CHECK(planes[i - 1].size >= planes[i].size);
  }
}

// Regions are convex polygons in their plane.
void check_regions(const std::vector<space::SpacePlane>& planes) {
  for (const space::SpacePlane& p : planes) {
    CHECK(p.plane.normal.norm() == doctest::Approx(1));
    CHECK_FALSE(p.regions.empty());
    for (const auto& region : p.regions)
      for (std::size_t i = 0; i < region.size(); ++i) {
        const Vec3 &a = region[i], &b = region[(i + 1) % 4], &c = region[(i + 2) % 4];
        CHECK(region.size() == 4);
        CHECK(std::abs(p.plane.signed_distance(a)) < 1e-6);
        CHECK(std::abs((b - a).dot(c - b)) < 1e-6);
      }
  }
}

bool touches(const space::SpacePlane& plane, const Vec3& place) {
  const PlaneFrame frame = frame_of(plane.plane);
  return std::any_of(plane.regions.begin(), plane.regions.end(), [&](const auto& region) {
    Eigen::AlignedBox2d box;
    for (const Vec3& p : region) box.extend(frame.to_plane(p));
    return box.contains(frame.to_plane(place));
  });
}

const SpaceStages& table_room() {
  static const SpaceStages stages = run_space(seen_from(table_room_sides(), {kScanner}));
  return stages;
}

}  // namespace

TEST_CASE("two planes of one wall a step apart get one step between them") {
  for (const double step : {0.03, 0.05, 0.1}) {
    const std::vector<space::SpacePlane> planes = stepped_wall(step).planes();
    const auto steps = planes_of_kind(planes, PlaneKind::step);
    REQUIRE(steps.size() == 1);
    CHECK(std::abs(steps[0].plane.normal.x()) > 0.999);
    CHECK(std::abs(steps[0].plane.signed_distance({1.5, 0, 1})) < 0.03);
    CHECK(steps[0].size == doctest::Approx(2).epsilon(0.05));
    for (const space::SpacePlane& p : planes_of_kind(planes, PlaneKind::surface)) CHECK(p.is_late);
    check_order(planes);
    check_regions(planes);
  }
}

TEST_CASE("planes that are nearly one, or far apart, get no step") {
  for (const double step : {0.01, 0.4}) {
    const std::vector<space::SpacePlane> planes = stepped_wall(step).planes();
    CHECK(planes_of_kind(planes, PlaneKind::step).empty());
    for (const space::SpacePlane& p : planes) CHECK_FALSE(p.is_late);
  }
}

TEST_CASE("a plane with points goes on beyond them, but not onto another one of the same wall") {
  const SpaceStages stages = stepped_wall(0.05);
  for (const space::SpacePlane& p : planes_of_kind(stages.planes(), PlaneKind::surface)) {
    const bool is_left = std::abs(p.plane.signed_distance({0, 0, 0})) < 0.02;
    CHECK(touches(p, {0.5, 0, 1}) == is_left);
    CHECK(touches(p, {2.5, 0, 1}) == !is_left);
    CHECK(touches(p, {is_left ? 0.5 : 2.5, 0, 2.3}));  // above
    CHECK_FALSE(touches(p, {is_left ? 2.0 : 1.0, 0, 1}));
  }
}

TEST_CASE("ends of faces in one plane get one plane, others their own") {
  SpaceStages stages = two_boards();
  const auto left = static_cast<int>(patch_at(stages.patches, {0.5, 0, 1}, Vec3::UnitY())),
             right = static_cast<int>(patch_at(stages.patches, {2.5, 0, 1}, Vec3::UnitY()));
  for (const double off : {0.0, 0.01, 0.015, 0.1}) {
    const auto top_edge = [](int patch, double from, double to, double height) {
      return surface::SharedEdge{plane_through({0, 0, height}, Vec3::UnitZ()),
                                 {{patch, {from, 0, height}, {to, 0, height}}}};
    };
    stages.edges = {top_edge(left, 0.05, 1, 2), top_edge(right, 2, 3, 2 + off)};
    const auto tops = planes_of_kind(stages.planes(), PlaneKind::edge);
    REQUIRE(tops.size() == (off < 0.012 ? 1 : 2));
    // Of the longer one, and so of both if they are one.
    CHECK(tops[0].plane.project(Vec3::Zero()).z() == doctest::Approx(2 + off));
    CHECK(touches(tops[0], {2.5, 0.2, 2}));
    CHECK(touches(tops.back(), {0.5, -0.2, 2}));
    CHECK_FALSE(touches(tops.back(), {1.5, 0, 2}));
    CHECK_FALSE(touches(tops.back(), {0.5, -0.3, 2}));
  }
}

TEST_CASE("where points end in a shadow there is no edge") {
  SpaceStages stages = two_boards();
  const auto wall = static_cast<int>(patch_at(stages.patches, {0, -1, 3}, Vec3::UnitY()));
  const double end = 1.5 - 0.5 * 4 / 3;  // of the shadow of the left board
  stages.edges = {
      {plane_through({end, -1, 0}, -Vec3::UnitX()), {{wall, {end, -1, 0.2}, {end, -1, 1.5}}}}};
  CHECK(planes_of_kind(stages.planes(), PlaneKind::edge).empty());
}

TEST_CASE("a table top whose underside rays pass gets a back as thick as a plate") {
  const SpaceStages& stages = table_room();
  const std::size_t top =
      patch_at(stages.patches, {kTableTop.center().x(), 1.4, kTableTop.max().z()}, Vec3::UnitZ());
  int backs = 0;
  for (const space::SpacePlane& p : planes_of_kind(stages.planes(), PlaneKind::back)) {
    if (p.patch != static_cast<int>(top)) continue;
    ++backs;
    CHECK(p.plane.normal.z() < -0.999);
    CHECK(p.plane.project(kTableTop.center()).z() ==
          doctest::Approx(kTableTop.max().z() - 0.04).epsilon(0.01));
    CHECK(touches(p, kTableTop.center()));
  }
  CHECK(backs == 1);
  const CellSet none;
  CHECK(planes_of_kind(space::planes_of_space(stages.input(), stages.outlook.sight, none),
                       PlaneKind::back)
            .empty());
}

TEST_CASE("a table top whose underside was seen gets no back, nor do walls that close a room") {
  const SpaceStages stages = run_space(seen_from(table_room_sides(), {kScanner, {3.6, 0.5, 0.3}}));
  patch_at(stages.patches, {2.8, 1.3, kTableTop.min().z()}, -Vec3::UnitZ());  // there it is
  for (const space::SpacePlane& p : planes_of_kind(stages.planes(), PlaneKind::back))
    CHECK(std::abs(p.plane.normal.z()) < 0.5);
  const SpaceStages room = run_space(seen_from(room_sides(), {kScanner}));
  CHECK(planes_of_kind(room.planes(), PlaneKind::back).empty());
}

TEST_CASE("each patch with points has one plane, its own, and large ones come first") {
  const SpaceStages& stages = table_room();
  const std::vector<space::SpacePlane> planes = stages.planes();
  std::vector<int> seen(stages.patches.size(), 0);
  for (const space::SpacePlane& p : planes_of_kind(planes, PlaneKind::surface)) {
    const auto k = static_cast<std::size_t>(p.patch);
    ++seen[k];
    CHECK(p.plane == stages.patches[k].plane);
    CHECK(p.size == stages.outlook.covers[k].area);
  }
  for (std::size_t k = 0; k < seen.size(); ++k)
    CHECK(seen[k] == (stages.outlook.covers[k].area >= 0.01));
  check_order(planes);
  check_regions(planes);
}
