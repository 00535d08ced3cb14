// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The command sim_check, as a user runs it.
#include <nlohmann/json.hpp>

#include "support/places.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

Outcome sim_check(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), SCANWORLD_SIM_CHECK);
  return run_program(arguments);
}

const std::string kRoom = "worlds/room.json";

}  // namespace

TEST_CASE("sim_check writes tables, figures and a plot, whole") {
  const TempFolder folder;
  const Outcome outcome =
      sim_check({in_project(kRoom), "--only", "speed", "--robots", "3", "--robot", "cube",
                 "--rounds", "1", "--steps", "4", "-o", folder / "out", "--json"});
  CHECK_MESSAGE(outcome.code == 0, outcome.err);
  CHECK(nlohmann::json::parse(outcome.out)["rows"].size() == 3);
  for (const char* name : {"sim_check.json", "sim_check.csv", "sim_check.md", "sim_check.svg"})
    CHECK(std::filesystem::file_size(folder / "out" / name) > 500);
  CHECK(read_file(folder / "out" / "sim_check.json") == outcome.out);
}

TEST_CASE("sim_check's exit codes tell what went wrong") {
  const TempFolder folder;
  const auto empty = write_file(folder / "empty.stl", "");
  CHECK(sim_check({}).code == 2);
  CHECK(sim_check({in_project(kRoom), "--budget", "soon"}).code == 2);
  CHECK(sim_check({in_project(kRoom), "--engine", "havok"}).code == 2);
  CHECK(sim_check({in_project(kRoom), "--poses", "p.txt"}).code == 2);
  const Outcome missing = sim_check({folder / "none.ply"});
  CHECK(missing.code == 3);
  CHECK(contains(missing.err, "none.ply"));
  CHECK(sim_check({empty}).code == 3);
  const Outcome over = sim_check({in_project(kRoom), "--only", "speed", "--robots", "1", "--robot",
                                  "cube", "--rounds", "1", "--steps", "2", "--budget", "1ns"});
  CHECK(over.code == 5);
  CHECK(contains(over.err, "contact test"));
}

TEST_CASE("table5 makes the meshes and worlds of a scan, and holds all against each other") {
  const TempFolder folder;
  const auto scan = folder / "room.ply";
  REQUIRE(run({"scan", in_project(kRoom), "-o", scan, "--points", "20000"}).code == 0);
  const Outcome outcome =
      sim_check({"table5", scan, "-o", folder / "out", "--nodes", "300", "--only", "speed",
                 "--robots", "3", "--robot", "cube", "--rounds", "1", "--steps", "4"});
  REQUIRE_MESSAGE(outcome.code == 0, outcome.err);
  const std::string table = read_file(folder / "out" / "table5.md");
  CHECK(table == outcome.out);
  for (const char* row :
       {"| gg |", "| gsrm |", "| gng |", "| thesis, triangles |", "| thesis, solids |",
        "| rival, triangles |", "| rival, solids |", "| plane |", "| empty |"})
    CHECK(contains(table, row));
  for (const char* file : {"gg.ply", "gsrm.ply", "gng.ply", "thesis/world.json", "rival/world.json",
                           "sim_check.json", "sim_check.svg"})
    CHECK(std::filesystem::exists(folder / "out" / file));
  CHECK(sim::read_place(folder / "out" / "gsrm.ply").seen.triangles.size() > 100);
}

TEST_CASE("baselines and tessellated worlds are written as PLY, and nothing else") {
  const TempFolder folder;
  const Outcome outcome = sim_check(
      {"tessellate", in_project(kRoom), "-o", folder / "dense.ply", "--triangles", "2000"});
  CHECK_MESSAGE(outcome.code == 0, outcome.err);
  CHECK(sim::read_place(folder / "dense.ply").seen.triangles.size() >= 2000);
  CHECK(sim_check({"tessellate", in_project(kRoom), "-o", folder / "dense.stl"}).code == 2);
  CHECK(sim_check({"baseline", "poisson", in_project(kRoom), "-o", folder / "m.ply"}).code == 2);
}
