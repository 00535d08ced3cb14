// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Labelled space as a whole, as reconstruct() has it.
#include "space/space.h"

#include <map>

#include "parallel.h"
#include "reconstruct.h"
#include "support/space.h"
#include "world/cracks.h"
#include "world/validate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

ReconstructOptions plane_by_plane() {
  ReconstructOptions options;
  options.space.is_on = false;
  return options;
}

// A room with a table that hides part of the floor, and the scanner what is below it.
const PointCloud& table_cloud() {
  static const PointCloud cloud = seen_from(table_room_sides(), {kScanner}).cloud;
  return cloud;
}

double loop_area(const World& world, const Loop& loop, const Vec3& normal) {
  Vec3 sum = Vec3::Zero();
  const auto at = [&](std::size_t i) { return world.vertices[static_cast<std::size_t>(loop[i])]; };
  for (std::size_t i = 2; i < loop.size(); ++i) sum += (at(i - 1) - at(0)).cross(at(i) - at(0));
  return normal.dot(sum) / 2;
}

double surface_area(const World& world, const Surface& s) {
  double area = loop_area(world, s.outer, s.plane.normal);
  for (const Loop& hole : s.holes) area += loop_area(world, hole, s.plane.normal);
  return area;
}

// How many edges are not used as often one way as the other.
std::size_t open_edges(const World& world) {
  std::map<std::pair<int, int>, int> uses;
  const auto add = [&](const Loop& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      uses[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  };
  for (const Surface& s : world.surfaces) {
    add(s.outer);
    for (const Loop& hole : s.holes) add(hole);
  }
  std::size_t open = 0;
  for (const auto& [edge, surplus] : uses) open += surplus != 0;
  return open;
}

std::size_t floors_of(const World& world) {
  return static_cast<std::size_t>(
      std::count_if(world.surfaces.begin(), world.surfaces.end(),
                    [](const Surface& s) { return s.kind == Kind::floor; }));
}

}  // namespace

TEST_CASE("labelled space is the default, and an option of its own turns it off") {
  ReconstructOptions options;
  CHECK(options.space.is_on);
  const OptionList list = list_options(options);
  const auto found =
      std::find_if(list.begin(), list.end(), [](const auto& o) { return o.name == "space.on"; });
  REQUIRE(found != list.end());
  space::SpaceOptions own;
  CHECK(space::list_options(own).size() > 20);
}

TEST_CASE("a bare room in labelled space is a box of six rectangles") {
  const World world = reconstruct(seen_from(room_sides(), {kScanner}).cloud).world;
  CHECK(validate(world).empty());
  REQUIRE(world.surfaces.size() == 6);
  CHECK(world.vertices.size() == 8);
  CHECK(open_edges(world) == 0);
  CHECK((bounds(world).sizes() - kRoomSize).norm() < 0.01);
  CHECK(floors_of(world) == 1);
}

TEST_CASE("in labelled space a floor is one surface, also under a table and under the scanner") {
  const World world = reconstruct(table_cloud()).world;
  CHECK(validate(world).empty());
  int floors = 0;
  double area = 0, top = 0;
  for (const Surface& s : world.surfaces) {
    if (s.plane.normal.z() < 0.99) continue;
    const double height = s.plane.project(Vec3::Zero()).z();
    if (std::abs(height) < 0.02) ++floors, area += surface_area(world, s);
    if (std::abs(height - kTableTop.max().z()) < 0.02) top += surface_area(world, s);
  }
  CHECK(floors == 1);
  CHECK(area == doctest::Approx(kRoomSize.x() * kRoomSize.y()).epsilon(0.01));
  CHECK(top == doctest::Approx(1.2 * 0.8).epsilon(0.03));
  // Plane by plane it has gaps there.
  const World plain = reconstruct(table_cloud(), plane_by_plane()).world;
  CHECK(open_edges(plain) > 0);
}

TEST_CASE("in labelled space a room and its table are watertight, without cracks") {
  const World world = reconstruct(table_cloud()).world;
  CHECK(open_edges(world) == 0);
  for (const Crack& crack : find_cracks(world)) FAIL_CHECK(text_of(crack));
}

TEST_CASE("labelled space makes the same bytes for any order of points and number of threads") {
  PointCloud cloud = table_cloud();
  const std::string before = world_text(reconstruct(cloud).world);
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    shuffle_points(cloud, 3 + static_cast<std::uint64_t>(threads));
    CHECK(world_text(reconstruct(cloud).world) == before);
  }
  CHECK(world_text(reconstruct(cloud, plane_by_plane()).world) != before);
}

TEST_CASE("labelled space closes a room also where nothing is known of viewpoints") {
  const World world = reconstruct(room_points(kRoomSize, 0.03, 0.003)).world;
  CHECK(validate(world).empty());
  CHECK(world.surfaces.size() == 6);
  CHECK(open_edges(world) == 0);
  CHECK((bounds(world).sizes() - kRoomSize).norm() < 0.01);
}

TEST_CASE("points are labelled with the surface in labelled space that they lie on") {
  const ReconstructResult result = reconstruct(table_cloud());
  std::map<int, const Surface*> by_id;
  for (const Surface& s : result.world.surfaces) by_id[s.id] = &s;
  REQUIRE(result.labels.size() == table_cloud().points.size());
  std::size_t labelled = 0, off = 0;
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    if (result.labels[i] < 0) continue;
    ++labelled;
    const Vec3 p = table_cloud().points[i].cast<double>();
    off += std::abs(by_id.at(result.labels[i])->plane.signed_distance(p)) > 0.03;
  }
  CHECK(static_cast<double>(labelled) > 0.98 * static_cast<double>(result.labels.size()));
  CHECK(off == 0);
}
