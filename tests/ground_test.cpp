// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "terrain/ground.h"

#include <algorithm>

#include "parallel.h"
#include "polygon.h"
#include "support/support.h"
#include "world/assemble.h"
#include "world/validate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::terrain;

namespace {

constexpr double kTolerance = 0.02;

// Flat up to x = 5, then a hill of 60 cm.
double hill(double x) { return x < 5 ? 0 : 0.3 * (1 - std::cos((x - 5) * M_PI / 5)); }

// Places on it, each 5 cm, from x0 to x1 and 5 m wide.
std::vector<Vec3> hill_places(double x0, double x1, double noise = 0.003) {
  Random random(7);
  std::vector<Vec3> places;
  for (double x = x0 + 0.025; x < x1; x += 0.05)
    for (double y = 0.025; y < 5; y += 0.05)
      places.emplace_back(x, y, hill(x) + noise * random.gauss());
  return places;
}

// A world with a floor from x = 0.
World floor_to(double x) {
  return assemble_world({{.plane = {Vec3::UnitZ(), 0},
                          .outer = {{0, 0, 0}, {x, 0, 0}, {x, 5, 0}, {0, 5, 0}},
                          .holes = {},
                          .support = {.points = 1000, .rms = 0.003, .coverage = 1}}},
                        Frame{});
}

Ground find(const World& world, const std::vector<Vec3>& places,
            const std::vector<SightLine>& lines = {}) {
  Ground ground = find_ground(world, places, lines, {kTolerance, 0.05});
  CHECK(validate(ground.world).empty());
  CHECK(ground.new_id.size() == world.surfaces.size());
  return ground;
}

geos::Rings plan_of(const World& world, const Surface& s) {
  geos::Rings rings;
  const auto add = [&](const Loop& loop) {
    rings.emplace_back();
    for (int v : loop)
      rings.back().push_back(world.vertices[static_cast<std::size_t>(v)].head<2>());
  };
  add(s.outer);
  for (const Loop& hole : s.holes) add(hole);
  return rings;
}

// The heights of the facets over and under a place.
std::vector<double> heights_at(const Ground& ground, const Vec2& p) {
  std::vector<double> heights;
  for (const Surface& s : ground.world.surfaces)
    if (s.ground && is_inside(plan_of(ground.world, s), p))
      heights.push_back(-s.plane.signed_distance(Vec3(p.x(), p.y(), 0)) / s.plane.normal.z());
  return heights;
}

}  // namespace

TEST_CASE("ground goes on where a floor ends, in few facets near what was seen") {
  const Ground ground = find(floor_to(5), hill_places(0, 15));
  CHECK(ground.new_id == std::vector<std::int32_t>{0});
  CHECK(ground.facets > 4);
  CHECK(ground.facets < 200);
  CHECK_FALSE(ground.world.surfaces[0].ground);
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const Vec2 p(random.uniform(5.3, 14.9), random.uniform(0.1, 4.9));
    const std::vector<double> heights = heights_at(ground, p);
    REQUIRE(heights.size() == 1);
    CHECK(std::abs(heights[0] - hill(p.x())) < kTolerance);
  }
  for (const Surface& s : ground.world.surfaces) CHECK(s.kind == Kind::floor);
}

TEST_CASE("facets of ground share their edges") {
  const Ground ground = find(floor_to(5), hill_places(0, 15));
  double sum = 0;
  std::vector<geos::Rings> plans;
  std::map<std::pair<int, int>, int> edges;
  for (const Surface& s : ground.world.surfaces) {
    if (!s.ground) continue;
    plans.push_back(plan_of(ground.world, s));
    for (const auto& ring : plans.back()) sum += doubled_area(ring) / 2;
    for (std::size_t k = 0; k < s.outer.size(); ++k)
      ++edges[std::minmax(s.outer[k], s.outer[(k + 1) % s.outer.size()])];
  }
  double whole = 0, around = 0, open = 0;
  for (const geos::Rings& part : geos::unite(plans))
    for (const auto& ring : part) {
      whole += doubled_area(ring) / 2;
      for (std::size_t k = 0; k < ring.size(); ++k)
        around += (ring[k] - ring[(k + 1) % ring.size()]).norm();
    }
  CHECK(sum == doctest::Approx(whole).epsilon(1e-6));
  const auto at = [&](int v) -> Vec2 {
    return ground.world.vertices[static_cast<std::size_t>(v)].head<2>();
  };
  for (const auto& [edge, count] : edges) {
    CHECK(count <= 2);
    if (count == 1) open += (at(edge.first) - at(edge.second)).norm();
  }
  CHECK(open == doctest::Approx(around).epsilon(1e-6));
}

TEST_CASE("what is flat, and things on it, stay as they are") {
  std::vector<Vec3> places = hill_places(0, 5);
  for (double x = 1; x < 4; x += 0.05)  // a table
    for (double y = 1; y < 4; y += 0.05) places.emplace_back(x, y, 0.7);
  const World world = floor_to(5);
  const Ground ground = find(world, places);
  CHECK(ground.facets == 0);
  CHECK(ground.world.surfaces == world.surfaces);
}

TEST_CASE("ground goes under what hides it, up to two metres, and not onto it") {
  std::vector<Vec3> places = hill_places(0, 15);
  std::erase_if(places, [](const Vec3& p) {
    return std::abs(p.x() - 10) < 0.75 && std::abs(p.y() - 2.5) < 0.75;
  });
  for (double x = 9.25; x < 10.75; x += 0.05)
    for (double y = 1.75; y < 3.25; y += 0.05) places.emplace_back(x, y, 1.2);
  const std::vector<double> heights = heights_at(find(floor_to(5), places), {10, 2.5});
  REQUIRE(heights.size() == 1);
  CHECK(std::abs(heights[0] - hill(10)) < 0.1);
}

TEST_CASE("stairs are no ground, they would need a facet each few centimetres") {
  Random random(5);
  std::vector<Vec3> places;
  for (double x = 0.025; x < 15; x += 0.05)
    for (double y = 0.025; y < 5; y += 0.05)
      places.emplace_back(x, y,
                          (x < 5 ? 0 : 0.05 * std::floor((x - 5) / 0.3)) + 0.003 * random.gauss());
  GroundOptions rough;
  rough.max_facets = 1e6;
  const GroundScale scale{kTolerance, 0.05};
  CHECK(find_ground(floor_to(5), places, {}, scale, rough).facets > 20 * 50);
  CHECK(find_ground(floor_to(5), places, {}, scale).facets == 0);
}

TEST_CASE("ground beside stairs stays where they are left out") {
  // A slope, and from y = 5 on stairs up it.
  std::vector<Vec3> places;
  for (double x = 0.025; x < 15; x += 0.05)
    for (double y = 0.025; y < 10; y += 0.05) {
      const double up = std::max(0.0, x - 5) / 6;
      places.emplace_back(x, y, y < 5 ? up : 0.05 * std::floor(up / 0.05));
    }
  GroundOptions options;
  options.max_facets = 6;
  const Ground ground = find_ground(floor_to(5), places, {}, {kTolerance, 0.05}, options);
  for (double x = 6; x < 14; x += 0.5) {
    CHECK(heights_at(ground, {x, 2}).size() == 1);
    CHECK(heights_at(ground, {x, 8}).empty());
  }
}

TEST_CASE("ground goes on for a metre beyond what was seen, as it rises there") {
  const Ground ground = find(floor_to(5), hill_places(0, 10));
  for (const double beyond : {0.3, 0.8}) {
    const std::vector<double> heights = heights_at(ground, {10 + beyond, 2.5});
    REQUIRE(heights.size() == 1);
    CHECK(std::abs(heights[0] - hill(10)) < 0.1);
  }
  CHECK(heights_at(ground, {11.5, 2.5}).empty());
}

TEST_CASE("the upper side of a ceiling is no ground") {
  FoundSurface ceiling{.plane = {-Vec3::UnitZ(), -0.2},
                       .outer = {{5, 0, -0.2}, {5, 5, -0.2}, {15, 5, -0.2}, {15, 0, -0.2}}};
  const FoundSurface floor{.plane = {Vec3::UnitZ(), 0},
                           .outer = {{0, 0, 0}, {5, 0, 0}, {5, 5, 0}, {0, 5, 0}},
                           .holes = {},
                           .support = {.points = 1000, .rms = 0.003, .coverage = 1}};
  CHECK(find(assemble_world({floor, ceiling}, Frame{}), hill_places(0, 8)).facets == 0);
}

TEST_CASE("a pit that one looks down into stays open") {
  std::vector<Vec3> places = hill_places(0, 15);
  std::erase_if(places, [](const Vec3& p) {
    return std::abs(p.x() - 10) < 0.5 && std::abs(p.y() - 2.5) < 0.5;
  });
  std::vector<SightLine> lines;
  for (double x = 9.5; x < 10.5; x += 0.04)
    for (double y = 2; y < 3; y += 0.04) {
      places.emplace_back(x, y, hill(10) - 1);
      lines.push_back({{10, 2.5, 2}, places.back()});
    }
  CHECK(heights_at(find(floor_to(5), places), {10, 2.5}).size() == 1);
  CHECK(heights_at(find(floor_to(5), places, lines), {10, 2.5}).empty());
}

TEST_CASE("a floor that is off the ground gives way to it") {
  const Ground ground = find(floor_to(15), hill_places(0, 15));
  CHECK(ground.new_id == std::vector<std::int32_t>{-1});
  CHECK(ground.world.surfaces.size() == ground.facets);
  CHECK(heights_at(ground, {2, 2}).size() == 1);
  CHECK(heights_at(ground, {9, 2}).size() == 1);
}

TEST_CASE("points on ground go to its facets, which know their support") {
  Ground ground = find(floor_to(5), hill_places(0, 15));
  PointCloud cloud;
  for (const Vec3& p : hill_places(0, 15, 0.002)) cloud.points.push_back(p.cast<float>());
  cloud.points.push_back(Vec3f(10, 2, 2));
  std::vector<std::int32_t> labels(cloud.points.size(), -1);
  labels[0] = 0;
  labels = label_ground({cloud, ground.world.frame}, std::move(labels), kTolerance, ground);
  CHECK(labels[0] == 0);
  CHECK(labels.back() == -1);
  int on_hill = 0, taken = 0;
  std::vector<std::size_t> count(ground.world.surfaces.size());
  for (std::size_t i = 0; i + 1 < labels.size(); ++i)
    if (cloud.points[i].x() > 5.3f && cloud.points[i].x() < 14.9f)
      ++on_hill, taken += labels[i] > 0;
  CHECK(taken > 0.95 * on_hill);
  for (const std::int32_t label : labels)
    if (label >= 0) ++count[static_cast<std::size_t>(label)];
  for (const Surface& s : ground.world.surfaces) {
    if (!s.ground) continue;
    CHECK(s.support.points == count[static_cast<std::size_t>(s.id)]);
    CHECK(s.support.rms < kTolerance);
  }
}

TEST_CASE("ground is the same for any order of places and number of threads") {
  std::vector<Vec3> places = hill_places(0, 15);
  const auto text_of = [&] { return world_text(find(floor_to(5), places).world); };
  const std::string text = text_of();
  std::reverse(places.begin(), places.end());
  CHECK(text_of() == text);
  const ThreadLimit one(1);
  CHECK(text_of() == text);
}

TEST_CASE("a stray far away changes nothing") {
  std::vector<Vec3> places = hill_places(0, 15);
  const std::string text = world_text(find(floor_to(5), places).world);
  places.insert(places.end(), {{1e6, 2, 0}, {-4, 3, -9e5}, {1e9, 1e9, 1e9}});
  CHECK(world_text(find(floor_to(5), places).world) == text);
}

TEST_CASE("nothing, and a single place, are no ground") {
  CHECK(find(floor_to(5), {}).facets == 0);
  CHECK(find(World{}, {{1, 2, 3}}).facets == 0);
}
