// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/refacet.h"

#include "error.h"
#include "support/scenes.h"
#include "world/assemble.h"
#include "world/cracks.h"
#include "world/validate.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

constexpr double kRound = 2, kTop = 6;  // [m] radius at the floor, and where the rulings end

// Of a section's corner at some height: of a vault, or of a cone with its apex at kTop + 2.
Vec3 corner_at(CurveType type, double angle, double height) {
  const double r = type == CurveType::cone ? kRound * (kTop + 2 - height) / (kTop + 2) : kRound;
  return {r * std::cos(angle), r * std::sin(angle), height};
}

// A part of a tower's side with so many facets, seen from inside, its floor and its flat top. All
// around it where `sweep` is 2 pi, else closed by a wall.
World tower(CurveType type, double sweep, int facets) {
  const bool is_whole = sweep > 6;
  std::vector<FoundSurface> surfaces;
  FoundSurface floor{.plane = {Vec3::UnitZ(), 0}}, top{.plane = {-Vec3::UnitZ(), kTop}};
  const auto at = [&](int k, double height) { return corner_at(type, sweep * k / facets, height); };
  for (int k = 0; k < facets; ++k) {
    const Vec3 a = at(k, 0), b = at(k + 1, 0), c = at(k + 1, kTop), d = at(k, kTop);
    FoundSurface side{.outer = {b, a, d, c}, .curve = 0};
    side.plane = plane_through(a, (a - b).cross(d - a).normalized());
    surfaces.push_back(side);
  }
  for (int k = 0; k < facets + !is_whole; ++k) {
    floor.outer.push_back(at(k, 0));
    top.outer.insert(top.outer.begin(), at(k, kTop));
  }
  surfaces.push_back(floor), surfaces.push_back(top);
  if (!is_whole) {
    FoundSurface wall{.outer = {at(0, 0), at(facets, 0), at(facets, kTop), at(0, kTop)}};
    const Vec3 normal =
        (wall.outer[1] - wall.outer[0]).cross(wall.outer[2] - wall.outer[1]).normalized();
    const double side = normal.dot(at(facets / 2, 0) - at(0, 0)) > 0 ? 1 : -1;
    wall.plane = plane_through(at(0, 0), side * normal);
    if (side < 0) std::reverse(wall.outer.begin(), wall.outer.end());
    surfaces.push_back(wall);
  }
  for (FoundSurface& s : surfaces) s.support.points = 1000;
  World world = assemble_world(surfaces, {});
  Curve curve;
  const bool is_cone = type == CurveType::cone;
  curve.shape = {type,
                 {0, 0, is_cone ? kTop + 2 : 0},
                 is_cone ? Vec3(-Vec3::UnitZ()) : Vec3::UnitZ(),
                 is_cone ? 0 : kRound,
                 is_cone ? std::atan(kRound / (kTop + 2)) : 0};
  curve.low = is_cone ? 2 : 0, curve.high = is_cone ? kTop + 2 : kTop;
  // A cone's axis is down: its angles go the other way.
  curve.start =
      is_cone ? Vec3(corner_at(CurveType::cylinder, sweep, 0) / kRound) : Vec3(Vec3::UnitX());
  curve.sweep = is_whole ? 2 * M_PI : sweep, curve.hollow = true;
  world.curves = {{0, curve}};
  return world;
}

std::size_t facet_count(const World& world) {
  std::size_t count = 0;
  for (const Surface& s : world.surfaces) count += s.curve.has_value();
  return count;
}

// The farthest that corners and middles of the facets' edges are off the curve.
double farthest(const World& world) {
  double most = 0;
  for (const Surface& s : world.surfaces) {
    if (!s.curve) continue;
    for (std::size_t k = 0; k < s.outer.size(); ++k) {
      const auto vertex = [&](std::size_t i) {
        return world.vertices[static_cast<std::size_t>(s.outer[i % s.outer.size()])];
      };
      for (const Vec3& p : {vertex(k), Vec3((vertex(k) + vertex(k + 1)) / 2)})
        most = std::max(most, std::abs(world.curves[0].curve.shape.signed_distance(p)));
    }
  }
  return most;
}

}  // namespace

TEST_CASE("facets are cut anew, finer or coarser, and all that meets them goes along") {
  for (const CurveType type : {CurveType::cylinder, CurveType::cone})
    for (const double sweep : {M_PI, 2.0, 2 * M_PI}) {
      CAPTURE(name_of(type));
      CAPTURE(sweep);
      const World world = tower(type, sweep, 12);
      REQUIRE(validate(world).empty());
      REQUIRE(find_cracks(world).empty());
      std::size_t before = 1000;
      for (const double sagitta : {0.001, 0.01, 0.1}) {
        CAPTURE(sagitta);
        const Refaceted cut = refacet(world, sagitta);
        CHECK(cut.kept.empty());
        for (const std::string& reason : validate(cut.world)) FAIL_CHECK(reason);
        CHECK(find_cracks(cut.world).empty());
        CHECK(facet_count(cut.world) < before);
        // Ends stay where they were, on the curve.
        CHECK(farthest(cut.world) <= sagitta);
        before = facet_count(cut.world);
        CHECK(cut.world.surfaces.size() - before == world.surfaces.size() - facet_count(world));
      }
    }
}

TEST_CASE("facets cut anew have no inferred parts of those that were there") {
  World world = tower(CurveType::cylinder, 2 * M_PI, 16);
  for (Surface& s : world.surfaces)
    if (s.curve) {
      const auto at = [&](std::size_t k) {
        return world.vertices[static_cast<std::size_t>(s.outer[k])];
      };
      s.inferred = {{{at(0), at(1), at(2)}, {}}};
    }
  REQUIRE(validate(world).empty());
  const Refaceted cut = refacet(world, 0.01);
  REQUIRE(cut.kept.empty());
  CHECK(validate(cut.world).empty());
  for (const Surface& s : cut.world.surfaces) CHECK(s.inferred.empty());
}

TEST_CASE("solids of a curve get as many sides as the sagitta asks for") {
  World world = full_world();
  world.obstacles[1].curve = 6;
  const auto corners = [&](double sagitta) {
    const World cut = refacet(world, sagitta).world;
    return std::get<ConvexHull>(cut.obstacles[1].shape).vertices.size();
  };
  CHECK(corners(0.001) > corners(0.01));
  CHECK(corners(0.1) == 12);
}

TEST_CASE("a sagitta that is none is refused") {
  CHECK_THROWS_AS(refacet(full_world(), 0), Error);
  CHECK_THROWS_AS(refacet(full_world(), NAN), Error);
}
