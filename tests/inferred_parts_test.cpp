// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/inferred_parts.h"

#include "find_inferred.h"
#include "polygon.h"
#include "reconstruct.h"
#include "support/space.h"
#include "world/fidelity_samples.h"
#include "world/leave_out.h"
#include "world/level.h"
#include "world/validate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// A floor of 4 m by 3 m at height 0.
FoundSurface floor_of_room() {
  return {.plane = {Vec3::UnitZ(), 0}, .outer = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}}};
}

double part_area(const InferredPart& part) {
  double sum = doubled_area(part.outer).norm() / 2;
  for (const auto& hole : part.holes) sum -= doubled_area(hole).norm() / 2;
  return sum;
}

double surfaces_area(const World& world) {
  double sum = 0;
  for (const Surface& s : world.surfaces) sum += area(world, s);
  return sum;
}

bool is_inferred(const Surface& surface, const Vec3& place) {
  const PlaneFrame frame = frame_of(surface.plane);
  const auto parts = inferred_rings(surface, frame);
  return surface.source == Source::inferred ||
         std::any_of(parts.begin(), parts.end(), [&](const geos::Rings& part) {
           return is_inside(part, frame.to_plane(place));
         });
}

// A room whose scanner sees neither what is right below it nor what a table hides.
const World& room() {
  static const World world = reconstruct(seen_from(table_room_sides(), {kScanner}).cloud).world;
  return world;
}

}  // namespace

TEST_CASE("what was measured nowhere is one part, what was measured all over has none") {
  CHECK(find_inferred(floor_of_room(), [](const Vec3&) { return true; }).empty());
  const auto parts = find_inferred(floor_of_room(), [](const Vec3&) { return false; });
  REQUIRE(parts.size() == 1);
  CHECK(part_area(parts[0]) == doctest::Approx(12).epsilon(0.001));
}

TEST_CASE("a disc that was not measured is a part, and one that was is a hole in it") {
  const auto distance = [](const Vec3& p) { return (p - Vec3(2, 1.5, 0)).norm(); };
  const auto inside =
      find_inferred(floor_of_room(), [&](const Vec3& p) { return distance(p) > 1; });
  REQUIRE(inside.size() == 1);
  CHECK(part_area(inside[0]) == doctest::Approx(M_PI).epsilon(0.05));
  const auto outside =
      find_inferred(floor_of_room(), [&](const Vec3& p) { return distance(p) < 1; });
  REQUIRE(outside.size() == 1);
  REQUIRE(outside[0].holes.size() == 1);
  CHECK(part_area(outside[0]) == doctest::Approx(12 - M_PI).epsilon(0.02));
}

TEST_CASE("a strip narrower than the least width is no part") {
  for (const double width : {0.05, 0.5}) {
    const auto parts = find_inferred(floor_of_room(),
                                     [&](const Vec3& p) { return p.x() < 2 || p.x() > 2 + width; });
    CHECK(parts.size() == (width > 0.1 ? 1 : 0));
  }
}

TEST_CASE("the floor below a scanner and below a table is told as inferred, and the rest is not") {
  CHECK(validate(room()).empty());
  for (const Surface& s : room().surfaces) {
    if (s.plane.normal.z() < 0.99 || std::abs(s.plane.offset) > 0.02) continue;
    CHECK(is_inferred(s, Vec3(kScanner.x(), kScanner.y(), 0)));
    CHECK_FALSE(is_inferred(s, Vec3(0.2, 0.2, 0)));
    CHECK_FALSE(is_inferred(s, Vec3(3.8, 0.2, 0)));
  }
  CHECK(inferred_area(room()) > 1);
  CHECK(inferred_area(room()) < 0.3 * surfaces_area(room()));
}

TEST_CASE("the text of a world holds its inferred parts, and a world turned has them turned") {
  CHECK(parse_world(world_text(room())) == room());
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  const World turned = moved(room(), turn, {1, 2, 3});
  CHECK(validate(turned).empty());
  CHECK(inferred_area(turned) == doctest::Approx(inferred_area(room())).epsilon(1e-4));
}

TEST_CASE("a point of an inferred part off its plane, and a ring of two points, are faults") {
  for (const bool is_off : {true, false}) {
    World world = room();
    for (Surface& s : world.surfaces) {
      if (s.inferred.empty()) continue;
      if (is_off)
        s.inferred[0].outer[0] += 0.1 * s.plane.normal;
      else
        s.inferred[0].outer.resize(2);
      break;
    }
    CHECK(validate(world).size() == 1);
  }
}

TEST_CASE("without what is inferred a world has the measured area left, and is sound") {
  World bare = leave_out(room(), {WorldPart::inferred});
  CHECK(validate(bare).empty());
  CHECK(inferred_area(bare) == 0);
  CHECK(surfaces_area(bare) ==
        doctest::Approx(surfaces_area(room()) - inferred_area(room())).epsilon(0.01));
  CHECK_FALSE(cut_inferred(bare));
}

TEST_CASE("fidelity looks at no place that was inferred") {
  const auto places = sample_surfaces(room(), 20000, 10);
  CHECK(places.size() > 1000);
  double sum = 0;
  for (const PlaceOnSurface& place : places) {
    CHECK_FALSE(is_inferred(room().surfaces[place.surface], place.at));
    sum += place.area;
  }
  CHECK(sum == doctest::Approx(surfaces_area(room()) - inferred_area(room())).epsilon(0.02));
}
