// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/world_json.h"

#include <nlohmann/json.hpp>

#include "support/scenes.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

using Json = nlohmann::ordered_json;

// The message for the full world with one value changed.
std::string error_with(const Json::json_pointer& at, const Json& value) {
  Json json = Json::parse(world_text(full_world()));
  json[at] = value;
  return error_of(Cause::bad_input, [&] { parse_world(json.dump(), "w.json"); });
}

}  // namespace

TEST_CASE("a world with everything in it is read as it was written, bit for bit") {
  const TempFolder folder;
  const World world = full_world();
  write_world(folder / "world.json", world);
  CHECK(read_world(folder / "world.json") == world);
  CHECK(read_world(folder.path()) == world);  // the folder stands for it
  CHECK(world_text(read_world(folder.path())) == world_text(world));
  CHECK(parse_world(world_text({})) == World{});
}

TEST_CASE("random numbers of any size survive writing and reading") {
  Random random(1);
  for (int round = 0; round < 50; ++round) {
    World world = small_world();
    for (int i = 0; i < 30; ++i)
      world.vertices.push_back(random.direction() * std::pow(10, random.whole(-300, 300)));
    world.vertices.push_back({-0.0, 5e-324, 1.7976931348623157e308});
    CHECK(parse_world(world_text(world)).vertices == world.vertices);
  }
}

TEST_CASE("what is wrong in a file is named by its place") {
  using P = Json::json_pointer;
  CHECK(contains(error_with(P("/schema/version"), 3), "w.json: world.schema: version 3"));
  CHECK(contains(error_with(P("/schema/name"), "other"), "not 'scanworld'"));
  CHECK(contains(error_with(P("/surfaces/1/kind"), "roof"),
                 "world.surfaces[1].kind: 'roof' is none of floor"));
  CHECK(contains(error_with(P("/surfaces/0/plane/normal/2"), "up"),
                 "world.surfaces[0].plane.normal[2]: should be a number"));
  CHECK(contains(error_with(P("/surfaces/0/colour"), Json::array({1, 2, 3})),
                 "unknown key 'colour'"));
  CHECK(contains(error_with(P("/surfaces/0/outer/1"), 1.5), "whole number"));
  CHECK(contains(error_with(P("/surfaces/0/support/points"), -1), "0 or more"));
  CHECK(contains(error_with(P("/surfaces/0/color/0"), 256), "at most 255"));
  CHECK(contains(error_with(P("/vertices/3"), Json::array({1, 2})),
                 "world.vertices[3]: should be a list of 3 numbers"));
  CHECK(contains(error_with(P("/frame/unit"), "ft"), "'m'"));
  CHECK(contains(error_with(P("/obstacles/0/cylinder"), Json::object()),
                 "one of box, hull and cylinder"));
  CHECK(contains(error_with(P("/openings/0/leaf/hinge"), "top"), "'top' is none of left, right"));
  CHECK(contains(error_with(P("/openings/0/leaf/opens_to"), "up"), "'up' is none of front, back"));
  CHECK(contains(error_with(P("/ways/0/kind"), "lift"), "'lift' is none of stairs, ramp"));
  CHECK(contains(error_with(P("/ways/0/kind"), "ramp"),
                 "world.ways[0]: a way of kind ramp has no 'steps'"));
  CHECK(contains(error_with(P("/ways/0/rooms"), Json::array({0})), "a list of 2 ids"));
  CHECK(contains(error_with(P("/ways/1/floors/1"), 0.5),
                 "world.ways[1].floors[1]: should be a whole"));
  CHECK(contains(error_with(P("/provenance/options/flag"), Json::array()), "plain value"));
  Json json = Json::parse(world_text(full_world()));
  json["surfaces"][1].erase("plane");
  CHECK(contains(error_of(Cause::bad_input, [&] { parse_world(json.dump(), "w.json"); }),
                 "world.surfaces[1]: has no 'plane'"));
}

TEST_CASE("what is no world is refused") {
  const TempFolder folder;
  for (const char* text : {"", "[]", "{}", "{\"schema\": 1}", "nothing",
                           "{\"schema\": {\"name\": \"scanworld\", \"version\": 1}}"})
    CHECK(contains(error_of(Cause::bad_input, [&] { parse_world(text, "w.json"); }), "w.json"));
  const std::string whole = world_text(full_world());
  CHECK(contains(
      error_of(Cause::bad_input, [&] { parse_world(whole.substr(0, whole.size() / 2), "w.json"); }),
      "line"));
  error_of(Cause::bad_input, [&] { read_world(folder / "absent.json"); });
  error_of(Cause::bad_input, [&] { read_world(folder.path()); });
}

TEST_CASE("the hash changes with the world, not with where it comes from") {
  World world = full_world();
  const std::string before = world_hash(world);
  world.provenance.program = "another";
  CHECK(world_hash(world) == before);
  world.vertices[0].x() += 1e-6;
  CHECK(world_hash(world) != before);
}

TEST_CASE(
    "a world is of version 2 only where something is round or uneven or has stairs, and both are "
    "read") {
  World world = full_world();
  CHECK(Json::parse(world_text(world))["schema"]["version"] == 2);
  world.ways.clear();
  CHECK(Json::parse(world_text(world))["schema"]["version"] == 2);
  world.openings[0].leaf.reset();
  world.curves.clear();
  world.surfaces[1].curve.reset(), world.obstacles[2].curve.reset();
  const std::string flat = world_text(world);
  CHECK(Json::parse(flat)["schema"]["version"] == 1);
  CHECK_FALSE(contains(flat, "curve"));
  CHECK_FALSE(contains(flat, "ways"));
  CHECK(parse_world(flat, "w.json") == world);
  world.surfaces[0].ground = true;
  const std::string uneven = world_text(world);
  CHECK(Json::parse(uneven)["schema"]["version"] == 2);
  CHECK(parse_world(uneven, "w.json") == world);
}

TEST_CASE("the worlds that come with the program are valid text of this version") {
  for (const char* name : {"room", "office", "stairs"}) {
    const auto path = in_project(std::string("worlds/") + name + ".json");
    CHECK(world_text(read_world(path)) == read_file(path));
  }
}
