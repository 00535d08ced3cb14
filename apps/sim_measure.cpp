// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What the verbs of sim_check share: how to measure, and where the figures go.
#include <fmt/format.h>

#include <algorithm>

#include "error.h"
#include "files.h"
#include "sim_check.h"
#include "sim_check/named.h"
#include "sim_check/report.h"

namespace scanworld::cli {

void MeasureRequest::add_to(CLI::App& app) {
  app.add_option("--robots", robots, "Numbers of robots")
      ->delimiter(',')
      ->check(CLI::Range(1, 10000))
      ->default_str("1,7,50,200");
  app.add_option("--robot", kinds, "Kinds of robots: cube, module")
      ->delimiter(',')
      ->check(CLI::IsMember({"cube", "module"}))
      ->default_str("cube,module");
  app.add_option("--size", options.size, "Of a robot [m]")
      ->check(CLI::Range(0.01, 10.0))
      ->capture_default_str();
  app.add_option("--rate", options.speed.rate, "Steps a second; 60 is a stress")
      ->check(CLI::Range(1.0, 100000.0))
      ->capture_default_str();
  app.add_option("--rounds", options.speed.rounds, "Rounds, in which all take turns")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--steps", options.speed.steps, "Steps in a round")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  app.add_option("--width", options.robustness.width, "Of the robot that goes through doors [m]")
      ->check(CLI::Range(0.05, 10.0))
      ->capture_default_str();
  app.add_option("--wheelbase", options.robustness.wheelbase,
                 "Narrower gaps in the floor are told [m]")
      ->check(CLI::Range(0.02, 10.0))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "Another seed, other ways of the robots")
      ->capture_default_str();
  app.add_option("--only", only, "speed or robustness alone")
      ->check(CLI::IsMember({"speed", "robustness"}));
  app.add_option("--engine", options.engine, "Physics engine: " + sim::names_of(sim::engines()))
      ->capture_default_str();
}

sim::CompareOptions MeasureRequest::resolved() const {
  sim::CompareOptions o = options;
  if (!robots.empty()) o.speed.robots = robots;
  std::ranges::sort(o.speed.robots);
  if (!kinds.empty()) o.speed.kinds.clear();
  for (const std::string& kind : kinds)
    o.speed.kinds.push_back(kind == "cube" ? sim::RobotKind::cube : sim::RobotKind::module);
  o.with_speed = only != "robustness", o.with_robustness = only != "speed";
  sim::engine_named(o.engine);
  return o;
}

void write_comparison(const std::filesystem::path& folder, const sim::Comparison& comparison) {
  write_text(folder / "sim_check.json", sim::json_of(comparison));
  write_text(folder / "sim_check.csv", sim::csv_of(comparison));
  write_text(folder / "sim_check.md", sim::markdown_of(comparison));
  write_text(folder / "sim_check.svg", sim::svg_of(comparison));
}

}  // namespace scanworld::cli
