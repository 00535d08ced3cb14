// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The command sim_check: holds worlds and meshes of a place against each other in a physics engine.
#include "sim_check.h"

#include <fmt/format.h>

#include <memory>
#include <new>

#include "cli.h"
#include "error.h"
#include "fidelity.h"
#include "files.h"
#include "scan/read_scan.h"
#include "sim_check/compare.h"
#include "sim_check/report.h"
#include "version.h"

namespace scanworld::cli {

namespace {

constexpr const char* kExamples = R"(Examples:
  sim_check mesh_of_the_scan.ply office          how much faster than the mesh the world is
  sim_check office --scan office.ply --poses poses.txt --only robustness
  sim_check mesh_of_the_scan.ply office -o comparison --rounds 15
Put first what the others are to be held against. docs/sim_check.md says how each figure is measured.
Exit codes: 0 done, 1 failure, 2 usage, 3 bad input, 4 nowhere for a robot to stand, 5 a promise of a
world is broken.)";

struct SimCheckRequest {
  std::vector<std::filesystem::path> places, scans;
  std::filesystem::path poses, out, svg;
  sim::CompareOptions options;
  std::vector<std::size_t> robots;
  std::vector<std::string> kinds;
  std::string as = "solids", unit, up, only, budget;
  bool json = false, csv = false;
  Console console;
};

// "5us", "0.1ms" or "1e-5s" in seconds.
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

void resolve(SimCheckRequest& request) {
  sim::CompareOptions& o = request.options;
  static const std::map<std::string, double> units = {
      {"", 0}, {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}};
  o.place.unit = units.at(request.unit);
  o.place.up = request.up.empty() ? '\0' : request.up[0];
  o.place.as_mesh = request.as == "triangles";
  o.both = request.as == "both";
  o.with_speed = request.only != "robustness", o.with_robustness = request.only != "speed";
  if (!request.robots.empty()) o.speed.robots = request.robots;
  std::ranges::sort(o.speed.robots);
  if (!request.kinds.empty()) {
    o.speed.kinds.clear();
    for (const std::string& kind : request.kinds)
      o.speed.kinds.push_back(kind == "cube" ? sim::RobotKind::cube : sim::RobotKind::module);
  }
  if (!request.budget.empty()) o.promises.budget = seconds_from(request.budget);
  sim::engine_named(o.engine);
  if (request.scans.empty() && !request.poses.empty())
    throw Error(Cause::usage, "--poses needs --scan");
}

void write_folder(const std::filesystem::path& path, const sim::Comparison& comparison) {
  OutputFolder folder(path, "sim_check.json");
  write_text(folder.path() / "sim_check.json", sim::json_of(comparison));
  write_text(folder.path() / "sim_check.csv", sim::csv_of(comparison));
  write_text(folder.path() / "sim_check.md", sim::markdown_of(comparison));
  write_text(folder.path() / "sim_check.svg", sim::svg_of(comparison));
  folder.commit();
}

void run(SimCheckRequest& request) {
  resolve(request);
  if (request.places.empty())
    throw Error(Cause::usage, "sim_check needs a WORLD, a .bullet file or a mesh (see --help)");
  const Progress progress = request.console.make_progress();
  PointCloud scan;
  if (!request.scans.empty()) {
    const std::vector<Vec3> poses =
        request.poses.empty() ? std::vector<Vec3>{} : read_poses(request.poses);
    scan = read_scan(request.scans);
    use_poses(scan, poses);
  }
  const sim::Comparison comparison = sim::compare(
      request.places, request.scans.empty() ? nullptr : &scan, request.options, progress);
  request.console.finish_progress();
  if (!request.out.empty()) write_folder(request.out, comparison);
  if (!request.svg.empty()) write_text(request.svg, sim::svg_of(comparison));
  fmt::print("{}", request.json  ? sim::json_of(comparison)
                   : request.csv ? sim::csv_of(comparison)
                                 : sim::markdown_of(comparison));
  if (!comparison.keeps_promises()) throw Error(Cause::check_failed, sim::verdict_of(comparison));
}

void add_measured(CLI::App& app, SimCheckRequest& request) {
  sim::CompareOptions& o = request.options;
  app.add_option("--robots", request.robots, "Numbers of robots")
      ->delimiter(',')
      ->check(CLI::Range(1, 10000))
      ->default_str("1,7,50,200");
  app.add_option("--robot", request.kinds, "Kinds of robots: cube, module")
      ->delimiter(',')
      ->check(CLI::IsMember({"cube", "module"}))
      ->default_str("cube,module");
  app.add_option("--size", o.size, "Of a robot [m]")
      ->check(CLI::Range(0.01, 10.0))
      ->capture_default_str();
  app.add_option("--rate", o.speed.rate, "Steps a second; 60 is a stress")
      ->check(CLI::Range(1.0, 100000.0))
      ->capture_default_str();
  app.add_option("--rounds", o.speed.rounds, "Rounds, in which all take turns")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--steps", o.speed.steps, "Steps in a round")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  app.add_option("--width", o.robustness.width, "Of the robot that goes through doors [m]")
      ->check(CLI::Range(0.05, 10.0))
      ->capture_default_str();
  app.add_option("--wheelbase", o.robustness.wheelbase, "Narrower gaps in the floor are told [m]")
      ->check(CLI::Range(0.02, 10.0))
      ->capture_default_str();
  app.add_option("--seed", o.seed, "Another seed, other ways of the robots")->capture_default_str();
  app.add_option("--only", request.only, "speed or robustness alone")
      ->check(CLI::IsMember({"speed", "robustness"}));
  app.add_option("--budget", request.budget,
                 "Mean time that a contact test may take in a world: 5us, 0.1ms")
      ->type_name("TIME");
}

void add_places(CLI::App& app, SimCheckRequest& request) {
  app.add_option(
         "places", request.places,
         "Worlds (a folder or world.json), .bullet files, and meshes; the first is what the "
         "others are held against")
      ->type_name("WORLD_OR_MESH");
  app.add_option("--as", request.as,
                 "What robots touch in worlds: solids, triangles or both in turn")
      ->check(CLI::IsMember({"solids", "triangles", "both"}))
      ->capture_default_str();
  app.add_option("--unit", request.unit, "Of meshes: m, cm, mm, in")
      ->check(CLI::IsMember({"m", "cm", "mm", "in"}));
  app.add_option("--up", request.up, "Axis of meshes that is up: z, y")
      ->check(CLI::IsMember({"z", "y"}))
      ->default_str("y of glTF, else z");
  std::string engines;
  for (const sim::EngineMaker& engine : sim::engines())
    engines += (engines.empty() ? "" : ", ") + engine.name;
  app.add_option("--engine", request.options.engine, "Physics engine: " + engines)
      ->capture_default_str();
  app.add_option("--scan", request.scans, "Scan to hold lidar and floor against")
      ->type_name("SCAN");
  app.add_option("--poses", request.poses, "Scanner positions, one a line")->type_name("F");
}

void add_outputs(CLI::App& app, SimCheckRequest& request) {
  app.add_flag("--json", request.json, "Print JSON");
  app.add_flag("--csv", request.csv, "Print CSV, a line per figure");
  app.add_option("--svg", request.svg, "Write a plot of the times")->type_name("F.svg");
  app.add_option("-o,--out", request.out, "Folder to write tables, CSV, JSON and plot to")
      ->type_name("DIR");
  request.console.add_to(app);
}

}  // namespace

void add_compare(CLI::App& app) {
  auto request = std::make_shared<SimCheckRequest>();
  add_places(app, *request);
  add_measured(app, *request);
  add_outputs(app, *request);
  app.footer(kExamples);
  app.callback([request, &app] {
    if (app.get_subcommands().empty()) run(*request);
  });
}

}  // namespace scanworld::cli
