// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "budget.h"

#include <fmt/format.h>

#include <cstdlib>

#include "cli.h"
#include "error.h"

namespace scanworld::cli {

double seconds_from(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  const double factor = unit == "us"   ? 1e-6
                        : unit == "ms" ? 1e-3
                        : unit == "s"  ? 1
                        : unit == "ns" ? 1e-9
                                       : 0;
  if (end == text.c_str() || factor == 0 || !(number > 0))
    throw Error(Cause::usage, "--budget: '" + text + "' is no time; write 5us or 0.1ms");
  return number * factor;
}

sim::Budget keep_budget(ReconstructResult& result, double limit) {
  sim::Budget budget = sim::meet_budget(result.world, limit);
  const double before = budget.tries.front().seconds, after = budget.tries.back().seconds;
  if (!budget.is_met) {
    std::string places;
    for (const std::string& place : budget.in_the_way) places += "\n  " + place;
    result.report.warnings.push_back(fmt::format(
        "a contact test takes {:.2f} us, and with all left out that can be {:.2f} us, more than "
        "the budget of {:.2f} us; the world is left as it is. It takes longest where solids lie in "
        "each other:{}",
        1e6 * before, 1e6 * after, 1e6 * limit, places));
    return budget;
  }
  result.world = budget.world;
  const std::set<int> kept = surface_ids(result.world);
  for (std::int32_t& label : result.labels)
    if (!kept.contains(label)) label = -1;
  const SimplifyOptions& simplified = budget.tries.back().simplified;
  result.world.provenance.options["budget.simple_obstacles"] = simplified.simple_obstacles;
  result.world.provenance.options["budget.min_size"] = simplified.min_size;
  return budget;
}

nlohmann::ordered_json json_of(const sim::Budget& budget) {
  Json tries = Json::array();
  for (const sim::BudgetTry& t : budget.tries)
    tries.push_back({{"simple_obstacles", t.simplified.simple_obstacles},
                     {"min_size", t.simplified.min_size},
                     {"surfaces", t.surfaces},
                     {"obstacles", t.obstacles},
                     {"solids", t.solids},
                     {"contact_test_seconds", t.seconds}});
  return {{"limit_seconds", budget.limit},
          {"met", budget.is_met},
          {"tries", tries},
          {"in_the_way", budget.in_the_way}};
}

}  // namespace scanworld::cli
