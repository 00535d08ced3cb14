// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sim_check/budget.h"

#include <nlohmann/json.hpp>

#include "support/places.h"

using namespace scanworld;
using namespace scanworld::sim;
using namespace scanworld::test;

namespace {

// A room full of small clutter, much of it in one place.
World cluttered() {
  World world = world_named("room");
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    OrientedBox box{.center = {random.uniform(0.5, 2.5), random.uniform(0.5, 2.5), 0.04},
                    .size = {0.08, 0.08, 0.08}};
    world.obstacles.push_back({1000 + i, box});
  }
  return world;
}

}  // namespace

TEST_CASE("a world that meets its budget stays as it is") {
  const World world = cluttered();
  const Budget budget = meet_budget(world, 1);
  CHECK(budget.is_met);
  CHECK(budget.tries.size() == 1);
  CHECK(budget.world == world);
}

TEST_CASE("what can't be met leaves the world as it is, and tells where it is slow") {
  const World world = cluttered();
  const Budget budget = meet_budget(world, 1e-9);
  CHECK_FALSE(budget.is_met);
  CHECK(budget.world == world);
  CHECK(budget.tries.size() == 6);
  REQUIRE(budget.in_the_way.size() == 5);
  CHECK(contains(budget.in_the_way[0], " us at "));
}

TEST_CASE("a world is simplified until it meets its budget") {
  const World world = cluttered();
  const Budget never = meet_budget(world, 1e-9);
  const double all = never.tries.front().seconds, least = never.tries.back().seconds;
  // So much apart that it does not matter whether others take a part of the machine.
  REQUIRE(least < all / 3);
  const Budget budget = meet_budget(world, std::sqrt(all * least));
  CHECK(budget.is_met);
  CHECK(budget.tries.back().seconds <= budget.limit);
  CHECK(budget.tries.front().seconds > budget.limit);
  CHECK(budget.world == simplify(world, budget.tries.back().simplified));
  CHECK(budget.world.obstacles.size() < world.obstacles.size());
}

TEST_CASE("build tells whether its world meets the budget, and keeps what it made") {
  const TempFolder folder;
  const auto scan = folder / "room.ply";
  REQUIRE(run({"scan", in_project("worlds/room.json"), "-o", scan, "--points", "20000"}).code == 0);
  const auto build = [&](const std::string& budget) {
    return run({"build", scan, "-o", folder / "w", "--budget", budget});
  };
  CHECK(build("1s").code == 0);
  const auto report = [&] {
    return nlohmann::json::parse(read_file(folder / "w" / "report.json"));
  };
  CHECK(report()["budget"]["met"] == true);
  const Outcome outcome = build("1ns");
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, "more than the budget"));
  CHECK(report()["budget"]["met"] == false);
  CHECK(build("5 apples").code == 2);
}
