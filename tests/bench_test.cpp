// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "support/support.h"

using namespace scanworld::test;

TEST_CASE("the bench tells times, counts and the score of a world, and no score of a scan") {
  const auto bench = [](std::vector<std::string> command) {
    command.insert(command.begin(), {SCANWORLD_BENCH, "--json", "--runs", "2"});
    const Outcome outcome = run_program(command);
    REQUIRE_MESSAGE(outcome.code == 0, outcome.err);
    return nlohmann::json::parse(outcome.out)["inputs"];
  };
  const auto world =
      bench({in_project("worlds/room.json"), "--points", "20000", "--noise", "0.005"})[0];
  CHECK(world["points"] == 20000);
  CHECK(world["all"]["in"] == 20000);
  CHECK(world["stages"].size() > 10);
  double seconds = 0;
  for (const auto& stage : world["stages"]) seconds += stage["seconds"].get<double>();
  CHECK(seconds > 0);
  for (const char* found : {"noise", "scale", "peak_memory_mb"})
    CHECK(world[found].get<double>() > 0);
  CHECK(world["score"]["asked_for"].get<int>() >= 6);
  CHECK(world["score"]["f1_50"].get<double>() > 0.5);

  const auto scans =
      bench({in_project("data/office.ply"), in_project("worlds/room.json"), "--points", "20000",
             "--noise", "0.005", "--method", "thesis", "--threads", "1"});
  REQUIRE(scans.size() == 2);
  CHECK(scans[0]["stages"][0]["name"] == "Reading");
  CHECK_FALSE(scans[0].contains("score"));
  CHECK(scans[1]["fingerprint"] == world["fingerprint"]);
  CHECK(scans[1]["world_hash"] != world["world_hash"]);
}
