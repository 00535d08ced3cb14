// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sim_check/compare.h"

#include <tinyxml2.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sim_check/baselines/tessellate.h"
#include "sim_check/report.h"
#include "support/places.h"

using namespace scanworld;
using namespace scanworld::sim;
using namespace scanworld::test;

namespace {

CompareOptions brief() {
  CompareOptions options;
  options.speed = {
      .robots = {2, 20}, .rounds = 3, .warm_up = 10, .steps = 10, .seconds = 0.1, .probes = 30};
  options.robustness = {
      .robots = 10, .seconds = 0.5, .speeds = {1}, .rates = {60}, .lanes = 1, .walls = 20};
  return options;
}

std::vector<Place> room_both_ways() {
  const Place world = place_of("the \"room\" <1>", world_named("room"));
  return {place_of("dense", tessellate(world.seen, {.triangles = 100000})), world};
}

const Comparison& room_comparison() {
  static const Comparison comparison = compare(room_both_ways(), nullptr, brief());
  return comparison;
}

}  // namespace

TEST_CASE("a world is faster than a dense mesh of it, and slower than a plane or nothing") {
  const Comparison& c = room_comparison();
  REQUIRE(c.rows.size() == 4);
  CHECK(c.rows[0].sort == Sort::mesh);
  CHECK(c.rows[1].sort == Sort::world);
  CHECK(c.rows[2].name == "plane");
  CHECK(c.rows[3].name == "empty");
  const Speed &dense = c.rows[0].speed, &world = c.rows[1].speed;
  CHECK(dense.triangles > 50 * world.triangles);
  CHECK(world.solids > 0);
  CHECK(dense.collide.ratio == 1);
  CHECK(world.collide.ratio > 5);
  CHECK(world.contact->ratio > 2);
  CHECK(world.steps.size() == 4);
  CHECK(world.steps[1].robots == 20);
  CHECK(world.steps[1].time.ratio > 2);
  CHECK(c.rows[3].speed.collide.ratio > world.collide.ratio);
  CHECK(world.collide_contacts > 0);
#ifndef __SANITIZE_ADDRESS__  // which keeps memory of its own
  CHECK(dense.memory > 20 * world.memory);
  CHECK(world.memory > 10000);
#endif
}

TEST_CASE("a world that keeps its promises is told from one that does not") {
  const Comparison& c = room_comparison();
  CHECK(c.keeps_promises());
  CHECK(c.rows[1].promises.size() >= 4);
  CHECK(c.rows[0].promises.empty());
  CompareOptions options = brief();
  options.with_speed = false;
  std::vector<Place> places = {place_of("room", world_named("room"))};
  std::erase_if(places[0].solids, [](const ExportBody& b) { return b.name.starts_with("wall"); });
  const Comparison broken = compare(std::move(places), nullptr, options);
  CHECK_FALSE(broken.keeps_promises());
  CHECK(contains(verdict_of(broken), "gets through a wall"));
}

TEST_CASE("a budget for contact tests is a promise like the others") {
  CompareOptions options = brief();
  options.with_robustness = false;
  options.promises.budget = 1;
  CHECK(compare({room_both_ways()[1]}, nullptr, options).keeps_promises());
  options.promises.budget = 1e-9;
  CHECK_FALSE(compare({room_both_ways()[1]}, nullptr, options).keeps_promises());
}

TEST_CASE("all reports hold what was measured, and are what they say") {
  const Comparison& c = room_comparison();
  const auto json = nlohmann::json::parse(json_of(c));
  REQUIRE(json["rows"].size() == 4);
  CHECK(json["rows"][1]["name"] == "the \"room\" <1>");
  CHECK(json["rows"][1]["speed"]["detection"]["ratio"].get<double>() ==
        c.rows[1].speed.collide.ratio);
  CHECK(json["keeps_promises"] == true);

  std::istringstream csv(csv_of(c));
  std::string line;
  std::getline(csv, line);
  const auto columns = std::ranges::count(line, ',');
  int lines = 0;
  for (; std::getline(csv, line); ++lines) CHECK(std::ranges::count(line, ',') == columns);
  CHECK(lines > 40);

  tinyxml2::XMLDocument svg;
  CHECK(svg.Parse(svg_of(c).c_str()) == tinyxml2::XML_SUCCESS);
  CHECK(contains(svg_of(c), "&lt;1&gt;"));

  const std::string text = markdown_of(c);
  CHECK(contains(text, "| plane"));
  CHECK(contains(text, "Verdict: all promises are kept."));
}

TEST_CASE(
    "robots start at the same spots, whatever the threads, and nowhere where there is no floor") {
  const auto places = room_both_ways();
  const Spots a = find_spots(places, {.count = 30}), b = find_spots(places, {.count = 30});
  REQUIRE(a.floor.size() == 30);
  CHECK(std::equal(a.floor.begin(), a.floor.end(), b.floor.begin()));
  for (std::size_t i = 0; i < a.floor.size(); ++i)
    for (std::size_t k = i + 1; k < a.floor.size(); ++k)
      CHECK((a.floor[i] - a.floor[k]).head<2>().norm() >= 0.149);
  const Place wall = boxes_place({box_body({0, 0, 0}, {5, 0.02, 3})});
  CHECK(contains(error_of(Cause::nothing_found, [&] { find_spots({wall}); }), "no place"));
}

TEST_CASE("an engine that there is not is refused, naming those there are") {
  CHECK(contains(error_of(Cause::usage, [] { engine_named("havok"); }), "bullet"));
}

TEST_CASE("other engines compare the same worlds, and what one does not take is told") {
  CompareOptions options = brief();
  options.speed.robots = {5};
  options.speed.kinds = {RobotKind::cube};
  for (const char* name : {"ode", "mujoco"}) {
    INFO(name);
    options.engine = name;
    const Comparison c = compare(room_both_ways(), nullptr, options);
    const bool meshes = engine_named(name).takes_meshes;
    CHECK(c.rows.size() == (meshes ? 4 : 3));
    CHECK(c.left_out.size() == (meshes ? 0 : 1));
    CHECK_FALSE(c.rows[0].speed.contact);
    CHECK(c.rows[meshes].sort == Sort::world);
    CHECK(c.rows[meshes].speed.steps[0].time.cpu.median > 0);
    CHECK(contains(markdown_of(c), name));
    if (meshes) CHECK(c.rows[1].speed.collide.ratio > 2);
  }
}
