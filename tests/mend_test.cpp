// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/mend.h"

#include <fmt/format.h>

#include "support/scenes.h"
#include "world/assemble.h"
#include "world/triangulate.h"
#include "world/validate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// A level surface with these corners, and its support.
FoundSurface level_surface(std::vector<Vec3> outer, std::vector<std::vector<Vec3>> holes = {}) {
  return {.plane = {Vec3::UnitZ(), 0},
          .outer = std::move(outer),
          .holes = std::move(holes),
          .support = {100, 0.01, 0.5}};
}

FoundSurface square_at(double x) {
  return level_surface({{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}});
}

// Two triangles, the larger one below, that meet at (0.75, 0.75).
FoundSurface bow_tie() { return level_surface({{0, 0, 0}, {1.5, 0, 0}, {0.5, 1, 0}, {1, 1, 0}}); }

// Mends the surfaces and checks what holds whatever they are.
Mended mend(const std::vector<FoundSurface>& surfaces, const Frame& frame = {}) {
  const Mended mended = mend_surfaces(assemble_world(surfaces, frame));
  CHECK(validate(mended.world).empty());
  CHECK_NOTHROW(triangulate(mended.world));
  REQUIRE(mended.from.size() == mended.world.surfaces.size());
  for (std::size_t i = 0; i < mended.from.size(); ++i) {
    CHECK(mended.world.surfaces[i].id == static_cast<int>(i));
    CHECK(mended.from[i] < surfaces.size());
  }
  return mended;
}

double area_of(const World& world) {
  double sum = 0;
  for (const Surface& s : world.surfaces) sum += area(world, s);
  return sum;
}

void check_valid(const Mended& kept) {
  const auto reasons = validate(kept.world);
  CHECK_MESSAGE(reasons.empty(), fmt::format("{}", fmt::join(reasons, "; ")));
}

}  // namespace

TEST_CASE("a bow tie becomes two surfaces, the larger one first with the support") {
  const Mended mended = mend({square_at(3), bow_tie(), square_at(5)});
  const World& world = mended.world;
  REQUIRE(world.surfaces.size() == 4);
  CHECK(mended.from == std::vector<std::size_t>{0, 1, 1, 2});
  CHECK(area(world, world.surfaces[1]) == doctest::Approx(0.5625));
  CHECK(area(world, world.surfaces[2]) == doctest::Approx(0.0625));
  CHECK(world.surfaces[1].support.points == 100);
  CHECK(world.surfaces[2].support.points == 0);
  CHECK(world.vertices.size() == 8 + 4 + 1);  // one new where the edges cross
  REQUIRE(mended.warnings.size() == 1);
  CHECK(contains(mended.warnings[0], "surface 1 was mended into 2 polygons"));
  CHECK(contains(mended.warnings[0], "(0.750, 0.750, 0.000) of the scan"));
}

TEST_CASE("an inferred part goes with the piece of a mended surface that it is in") {
  FoundSurface tie = bow_tie();
  tie.inferred = {{{{0.6, 0.2, 0}, {0.9, 0.2, 0}, {0.9, 0.3, 0}}, {}}};  // in the larger triangle
  const World world = mend({tie}).world;
  REQUIRE(world.surfaces.size() == 2);
  CHECK(world.surfaces[0].inferred == tie.inferred);
  CHECK(world.surfaces[1].inferred.empty());
}

TEST_CASE("what is less than a hundredth of the rest of a surface is left out") {
  const Mended mended = mend({level_surface({{0, 0, 0}, {1, 0, 0}, {0.49, 1, 0}, {0.51, 1, 0}})});
  CHECK(mended.world.surfaces.size() == 1);
}

TEST_CASE("a polygon that touches itself is parted where it does") {
  // Two squares that share the corner (1, 1), as one loop.
  const Mended mended = mend({level_surface(
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {1, 1, 0}, {0, 1, 0}})});
  REQUIRE(mended.world.surfaces.size() == 2);
  CHECK(area_of(mended.world) == doctest::Approx(2));
  CHECK(mended.world.vertices.size() == 7);
  CHECK(contains(mended.warnings.at(0), "(1.000, 1.000, 0.000) of the scan"));
}

TEST_CASE("a hole that crosses the outer loop becomes a notch, nothing outside is filled") {
  const Mended mended = mend({level_surface({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}},
                                            {{{3, 1, 0}, {3, 2, 0}, {5, 2, 0}, {5, 1, 0}}})});
  REQUIRE(mended.world.surfaces.size() == 1);
  CHECK(mended.world.surfaces[0].holes.empty());
  CHECK(area_of(mended.world) == doctest::Approx(11));
  CHECK(bounds(mended.world).max().x() == doctest::Approx(4));
}

TEST_CASE("a corner off its plane by more than the tolerance is put into it, and told") {
  FoundSurface bent = square_at(0);
  bent.outer[2].z() = 5e-3;
  const Mended mended = mend({square_at(0), bent});
  REQUIRE(mended.world.surfaces.size() == 2);
  CHECK(area_of(mended.world) == doctest::Approx(2));
  CHECK(contains(mended.warnings.at(0), "surface 1 was mended into 1 polygon:"));
  CHECK(contains(mended.warnings[0], "a corner is 0.0050 m off its plane"));
  CHECK(contains(mended.warnings[0], "(1.000, 1.000, 0.005) of the scan"));
}

TEST_CASE("what holds nothing sound is left out with its place, the rest stays as it was") {
  const double far = 1e12;
  for (const FoundSurface& broken :
       {level_surface({{2, 2, 0}, {3, 2, 0}, {4, 2, 0}}),
        level_surface({{2, 2, 0}, {2, 2, 0}, {2, 2, 0}}),
        level_surface({{2, 2, 0}, {3, 2, 0}, {3, far, 0}, {2, far, 0}}),
        level_surface({{2, 2, 0}, {3, 2, 0}, {2, 2, 0}, {3, 2, 0}})}) {
    const Mended mended = mend({square_at(0), broken, square_at(1)});
    CHECK(mended.from == std::vector<std::size_t>{0, 2});
    CHECK(mended.world.vertices.size() == 6);
    CHECK(contains(mended.warnings.at(0), "a surface of 100 points is left out"));
    CHECK(contains(mended.warnings[0], "of the scan"));
  }
}

TEST_CASE("places are in the coordinates of the scan") {
  Frame frame;
  frame.origin = {1000, 2000, 30};
  frame.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()));
  const Mended mended = mend({bow_tie()}, frame);
  CHECK(contains(mended.warnings.at(0), "(999.250, 2000.750, 30.000) of the scan"));

  World world = full_world();
  world.frame.origin = frame.origin, world.frame.rotation = frame.rotation;
  std::get<Cylinder>(world.obstacles[2].shape).radius = 0;
  const Mended kept = leave_out_invalid(world);
  CHECK(contains(kept.warnings.at(0), "obstacle 2"));
  CHECK(contains(kept.warnings[0], "(998.000, 2002.000, 31.000) of the scan"));
}

TEST_CASE("valid worlds stay the same bytes") {
  for (const World& world :
       {small_world(), full_world(), read_world(in_project("worlds/office.json"))}) {
    const Mended kept = leave_out_invalid(world);
    CHECK(world_text(kept.world) == world_text(world));
    CHECK(kept.warnings.empty());
    CHECK(kept.from.size() == world.surfaces.size());
  }
  const World squares = assemble_world({square_at(0), square_at(1)}, {});
  CHECK(world_text(mend_surfaces(squares).world) == world_text(squares));
}

TEST_CASE("what refers to a surface that is gone goes with it, the rest keeps its id") {
  World world = full_world();
  world.vertices[static_cast<std::size_t>(world.surfaces[1].holes[0][0])].y() = 0.5;
  const Mended kept = leave_out_invalid(world);
  check_valid(kept);
  REQUIRE(kept.world.surfaces.size() == 1);
  CHECK(kept.world.surfaces[0].id == 0);
  CHECK(kept.from == std::vector<std::size_t>{0});
  CHECK(kept.world.openings.empty());
  CHECK(kept.world.doors.empty());
  CHECK(kept.world.colliders.size() == 1);
  CHECK(kept.world.obstacles == world.obstacles);
  REQUIRE(kept.world.rooms.size() == 2);
  CHECK(kept.world.rooms[0].surfaces == std::vector<int>{0});
  CHECK(kept.world.vertices.size() == 4);
  CHECK(kept.warnings.size() == 4);  // the wall, its opening, its collider, the door
  for (const std::string& warning : kept.warnings) CHECK(contains(warning, "is left out, at ("));
}

TEST_CASE("whatever is wrong with one thing, the rest stays and the world is valid") {
  const World whole = full_world();
  const auto left = [&](auto change) {
    World world = whole;
    change(world);
    REQUIRE_FALSE(validate(world).empty());
    const Mended kept = leave_out_invalid(world);
    check_valid(kept);
    CHECK_FALSE(kept.warnings.empty());
    return kept.world;
  };
  World world = left([](World& w) { w.openings[0].width = 0; });
  CHECK(world.openings.empty());
  CHECK(world.doors.empty());
  CHECK(world.surfaces.size() == 2);
  CHECK(left([](World& w) { w.openings[0].surface = 5; }).openings.empty());
  CHECK(left([](World& w) { w.colliders[0].surface = 5; }).colliders.size() == 1);
  CHECK(left([](World& w) {
          std::get<ConvexPrism>(w.colliders[1].shape).base.clear();
        }).colliders.size() == 1);
  CHECK(left([](World& w) {
          std::get<ConvexHull>(w.obstacles[1].shape).vertices.clear();
        }).obstacles.size() == 2);
  world = left([](World& w) { w.rooms[1].area = -1; });
  CHECK(world.rooms.size() == 1);
  CHECK(world.doors.empty());
  CHECK(world.openings.size() == 1);
  CHECK(left([](World& w) { w.rooms[0].surfaces.push_back(5); }).rooms.size() == 2);
  CHECK(left([](World& w) { w.doors[0].rooms[1] = 5; }).doors.empty());
}

TEST_CASE("a vertex that is nowhere takes with it what has it, and nothing else") {
  World world = full_world();
  world.vertices[static_cast<std::size_t>(world.surfaces[1].holes[0][2])].x() = NAN;
  const Mended kept = leave_out_invalid(world);
  check_valid(kept);
  CHECK(kept.world.surfaces.size() == 1);
  CHECK(kept.world.obstacles.size() == 3);
  CHECK(kept.world.rooms.size() == 2);
}

TEST_CASE("facets and columns stay when their curve is no good") {
  World world = full_world();
  world.curves[0].curve.shape.radius = -1;
  const Mended kept = leave_out_invalid(world);
  check_valid(kept);
  CHECK(kept.world.curves.size() == 2);
  CHECK(kept.world.surfaces.size() == 2);
  CHECK(kept.world.obstacles.size() == 3);
  CHECK_FALSE(kept.world.obstacles[2].curve);
  CHECK(kept.world.surfaces[1].curve == 5);
}

TEST_CASE("surfaces of corners by chance are mended or left out") {
  Random random(3);
  for (int run = 0; run < 200; ++run) {
    CAPTURE(run);
    std::vector<FoundSurface> surfaces;
    for (int s = random.whole(1, 4); s > 0; --s) {
      const auto loop = [&] {
        std::vector<Vec3> corners;
        for (int k = random.whole(3, 8); k > 0; --k)
          corners.emplace_back(random.whole(0, 5), random.whole(0, 5), 1e-3 * random.whole(0, 2));
        return corners;
      };
      FoundSurface& found = surfaces.emplace_back(level_surface(loop()));
      for (int h = random.whole(0, 2); h > 0; --h) found.holes.push_back(loop());
    }
    const Mended mended = mend(surfaces);
    CHECK(world_text(mend(surfaces).world) == world_text(mended.world));
  }
}
