// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What the options of an export do to a world.
#include "exporters/assimp.h"
#include "exporters/bodies.h"
#include "exporters/export.h"
#include "exporters/parts.h"
#include "support/scenes.h"
#include "world/level.h"
#include "world/validate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

World hall() { return read_world(in_project("worlds/office.json")); }

Box3 bounds_in(const std::filesystem::path& file) {
  Box3 box;
  for (const Vec3& v : read_mesh(file).vertices) box.extend(v);
  return box;
}

}  // namespace

TEST_CASE("a world without colliders gets them, one with colliders keeps its own") {
  const World world = hall();
  REQUIRE(world.colliders.empty());
  const World prepared = prepare_export(world, {});
  CHECK_FALSE(prepared.colliders.empty());
  CHECK(prepare_export(prepared, {}) == prepared);
}

TEST_CASE(
    "the origin, up and upright worlds are as asked, and scan coordinates stay what they were") {
  const World world =
      moved(hall(), Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Vec3::UnitX())), {1, 2, 3});
  const ExportOptions options{.origin = {5, -3, 1}, .level = true, .y_up = true};
  const World prepared = prepare_export(world, options);
  CHECK(validate(prepared).empty());
  CHECK((prepared.frame.up - Vec3::UnitY()).norm() < 1e-9);
  for (std::size_t i = 0; i < world.vertices.size(); ++i)
    CHECK((prepared.frame.to_scan(prepared.vertices[i]) - world.frame.to_scan(world.vertices[i]))
              .norm() < 1e-5);
  const World shifted = prepare_export(hall(), {.origin = {5, -3, 1}});
  CHECK((shifted.vertices[0] - hall().vertices[0] + Vec3(5, -3, 1)).norm() < 1e-6);
}

TEST_CASE("with Y up a file's highest point is along y; formats with an axis of their own refuse") {
  const TempFolder folder;
  const Box3 box = bounds(hall());
  for (const ExportFormat& format : export_formats()) {
    const auto file = folder / ("world." + format.extension);
    if (!format.any_up) {
      CHECK(contains(error_of(Cause::usage, [&] { export_world(hall(), file, {.y_up = true}); }),
                     "--up"));
      continue;
    }
    export_world(hall(), file, {.y_up = true});
    if (format.name == "obj" || format.name == "stl")
      CHECK(bounds_in(file).max().y() == doctest::Approx(box.max().z()).scale(0).epsilon(1e-4));
  }
}

TEST_CASE("surfaces have the scan's colour, or that of their kind where asked") {
  World world = small_world();
  world.surfaces[0].color = Color{1, 2, 3};
  CHECK(export_parts(prepare_export(world, {}))[0].color == Color{1, 2, 3});
  CHECK(export_parts(prepare_export(world, {.color_by_kind = true}))[0].color ==
        color_of(world.surfaces[0].kind));
}

TEST_CASE("merged, all that is seen is one mesh with all the triangles") {
  const auto apart = export_parts(hall()), merged = export_parts(hall(), {.merge = true});
  REQUIRE(merged.size() == 1);
  std::size_t triangles = 0;
  for (const ExportPart& part : apart) triangles += part.mesh.triangles.size();
  CHECK(merged[0].mesh.triangles.size() == triangles);
  CHECK(export_parts({}, {.merge = true}).empty());
}

TEST_CASE("a world within the budget is written, one over it is refused with the numbers") {
  const World world = prepare_export(hall(), {});
  const std::size_t solids = export_bodies(world, {}).size();
  prepare_export(world, {.budget = {.solids = solids}});
  const std::string why =
      error_of(Cause::usage, [&] { prepare_export(world, {.budget = {.solids = solids - 1}}); });
  CHECK(contains(why, std::to_string(solids) + " solids"));
  CHECK(contains(why, std::to_string(solids - 1)));
  for (const char* cap : {"faces=1", "hulls=1", "hull_vertices=5"})
    error_of(Cause::usage, [&] { prepare_export(full_world(), {.budget = budget_from(cap)}); });
}

TEST_CASE("a budget is read from its text, and what is no cap is told") {
  const ExportBudget budget = budget_from("faces=200000,hull_vertices=60");
  CHECK(budget.faces == 200000);
  CHECK(budget.hull_vertices == 60);
  CHECK(budget.solids == 0);
  for (const char* text :
       {"solid=3", "solids=", "solids=x", "solids=-1", "solids=0", "solids", "faces=1,,hulls=2"})
    CHECK(contains(error_of(Cause::usage, [&] { budget_from(text); }), "is no cap"));
}
