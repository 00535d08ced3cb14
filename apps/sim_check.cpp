// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The command sim_check without a verb: holds worlds and meshes of a place against each other.
#include "sim_check.h"

#include <fmt/format.h>

#include <map>
#include <memory>

#include "budget.h"
#include "cli.h"
#include "error.h"
#include "fidelity.h"
#include "files.h"
#include "output_folder.h"
#include "sim_check/report.h"
#include "world/world_json.h"

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
  MeasureRequest measure;
  std::string as = "solids", unit, up, budget;
  bool json = false, csv = false;
  Console console;
};

sim::CompareOptions resolve(const SimCheckRequest& request) {
  if (request.places.empty())
    throw Error(Cause::usage, "sim_check needs a WORLD, a .bullet file or a mesh (see --help)");
  if (request.scans.empty() && !request.poses.empty())
    throw Error(Cause::usage, "--poses needs --scan");
  sim::CompareOptions o = request.measure.resolved();
  static const std::map<std::string, double> units = {
      {"", 0}, {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}};
  o.place.unit = units.at(request.unit);
  o.place.up = request.up.empty() ? '\0' : request.up[0];
  o.place.as_mesh = request.as == "triangles";
  o.both = request.as == "both";
  if (!request.budget.empty()) o.promises.budget = seconds_from(request.budget);
  return o;
}

std::vector<std::filesystem::path> inputs_of(const SimCheckRequest& request) {
  std::vector<std::filesystem::path> inputs = request.scans;
  inputs.push_back(request.poses);
  for (const auto& place : request.places) inputs.push_back(world_file(place));
  return inputs;
}

void run(const SimCheckRequest& request) {
  const sim::CompareOptions options = resolve(request);
  std::optional<OutputFolder> folder;
  if (!request.out.empty()) folder.emplace(request.out, "sim_check.json", inputs_of(request));
  if (!request.svg.empty()) check_output(request.svg, inputs_of(request));
  const Progress progress = request.console.make_progress();
  std::optional<PointCloud> scan;
  if (!request.scans.empty()) scan = read_scan_with_poses(request.scans, request.poses);
  const sim::Comparison comparison =
      sim::compare(request.places, scan ? &*scan : nullptr, options, progress);
  request.console.finish_progress();
  if (folder) {
    write_comparison(folder->path(), comparison);
    for (const std::string& file : folder->commit()) request.console.warn(file);
  }
  if (!request.svg.empty()) write_text(request.svg, sim::svg_of(comparison));
  fmt::print("{}", request.json  ? sim::json_of(comparison)
                   : request.csv ? sim::csv_of(comparison)
                                 : sim::markdown_of(comparison));
  if (!comparison.keeps_promises()) throw Error(Cause::check_failed, sim::verdict_of(comparison));
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
  app.add_option("--scan", request.scans, "Scan to hold lidar and floor against")
      ->type_name("SCAN");
  app.add_option("--poses", request.poses, kPosesHelp)->type_name("F");
  app.add_option("--budget", request.budget,
                 "Mean time that a contact test may take in a world: 5us, 0.1ms")
      ->type_name("TIME");
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
  request->measure.add_to(app);
  add_outputs(app, *request);
  app.footer(kExamples);
  app.callback([request, &app] {
    if (app.get_subcommands().empty()) run(*request);
  });
}

}  // namespace scanworld::cli
