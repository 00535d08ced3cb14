// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "exporters/export.h"

#include <fmt/format.h>

#include <memory>

#include "cli.h"
#include "error.h"
#include "facets.h"
#include "fidelity.h"
#include "files.h"
#include "output_folder.h"
#include "scan/read_scan.h"
#include "world/level.h"
#include "world/world_json.h"

namespace scanworld::cli {

namespace {

struct ExportRequest {
  std::filesystem::path world, out, poses;
  std::string format, up = "z", color = "scan", budget, sagitta, without;
  std::vector<double> origin = {0, 0, 0};
  std::vector<double> band = {ExportOptions{}.band_low, ExportOptions{}.band_high};
  bool all = false, measured_only = false;
  ExportOptions options;
  Console console;
};

void run_on_scan(const ExportRequest& request) {
  if (request.all)
    throw Error(Cause::usage, request.world.string() + ": --all needs a world; see build");
  if (!request.options.without.empty())
    throw Error(Cause::usage, request.world.string() +
                                  ": --without and --measured-only go with a world, not a scan");
  scan_export_format(request.out, request.format);  // before the scan is read
  const PointCloud scan = read_scan_with_poses({request.world}, request.poses);
  export_scan(scan, request.out, request.options, request.format);
}

void run(ExportRequest request) {
  ExportOptions& options = request.options;
  options.sagitta = sagitta_from(request.sagitta);
  options.without = parts_from(request.without);
  if (request.measured_only) options.without.insert(WorldPart::inferred);
  options.y_up = request.up == "y";
  options.color_by_kind = request.color == "kind";
  options.origin = {request.origin[0], request.origin[1], request.origin[2]};
  options.budget = budget_from(request.budget);
  options.band_low = request.band[0], options.band_high = request.band[1];
  if (!(options.band_low >= 0 && options.band_low < options.band_high))
    throw Error(Cause::usage, "--band: LOW should be 0 or more, and less than HIGH");
  if (request.all && !request.format.empty())
    throw Error(Cause::usage, "--all writes every format; leave --format out");
  // What is wrong with the output is told before the world is read.
  const std::vector<std::filesystem::path> inputs = {world_file(request.world), request.poses};
  std::optional<OutputFolder> folder;
  if (request.all) {
    folder.emplace(request.out, kFormatsMark, inputs);
  } else {
    export_format(request.out, request.format);
    check_output(request.out, inputs);
  }
  if (std::filesystem::is_regular_file(request.world) && kind_of(request.world) == FileKind::scan)
    return run_on_scan(request);
  if (!request.poses.empty())
    throw Error(Cause::usage, request.poses.string() + ": --poses goes with a scan, not a world");
  const World world = cut_anew(read_valid_world(request.world), options.sagitta, request.console);
  if (const double tilt = tilt_of(world.frame) * 180 / M_PI; tilt > 0.5 && !options.level)
    request.console.warn(
        fmt::format("the world is tilted by {:.1f} degrees; --level makes it upright", tilt));
  if (!request.all) return export_world(world, request.out, options, request.format);
  for (const LeftOut& format : write_formats(folder->path(), world, options))
    request.console.warn("left out " + format.format + ": " + format.why);
  for (const std::string& file : folder->commit()) request.console.warn(file);
}

std::string footer() {
  std::string text = "Formats:\n";
  for (const ExportFormat& f : export_formats())
    text +=
        fmt::format("  {:<9} {}\n",
                    f.name + (f.extension == f.name ? "" : " (." + f.extension + ")"), f.describes);
  return text +
         "\nExamples:\n  scanworld export office -o office.glb\n"
         "  scanworld export office -o office_for_all --all\n"
         "  scanworld export office -o bare.obj --without obstacles\n"
         "  scanworld export office.ply -o grid.ot --poses poses.txt --resolution 0.1\n"
         "  scanworld export office -o office.xml --budget solids=500,hull_vertices=60";
}

}  // namespace

void add_export(CLI::App& app) {
  auto request = std::make_shared<ExportRequest>();
  ExportOptions& options = request->options;
  CLI::App* verb = app.add_subcommand("export", "Write a world in another format");
  verb->add_option("world", request->world, "A world.json or its folder; for grids a scan as well")
      ->required()
      ->type_name("WORLD");
  verb->add_option("-o,--out", request->out, "File to write; with --all a folder")
      ->required()
      ->type_name("OUT");
  verb->add_option("--format", request->format, "Format, where the extension does not tell it");
  verb->add_flag("--all", request->all, "Write every format, and a README how to load each");
  add_sagitta(*verb, request->sagitta);
  verb->add_option(
          "--without", request->without,
          "Parts to leave out, joined by commas: obstacles, colliders, openings, surfaces "
          "(and their colliders), inferred (surfaces and parts of them that were not measured)")
      ->type_name("LIST");
  verb->add_flag("--measured-only", request->measured_only,
                 "Leave out what was not measured: the same as --without inferred");
  verb->add_option("--friction", options.friction, "Of all solids")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  verb->add_option("--thickness", options.min_thickness,
                   "Least thickness of colliders [m]; thinner ones grow away from the free side")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  verb->add_option("--origin", request->origin, "Point of the world that becomes the origin [m]")
      ->expected(3)
      ->type_name("X Y Z");
  verb->add_flag("--level", options.level, "Turn the world upright, so that up is +z");
  verb->add_option("--up", request->up, "Axis that is up, where the format lets one choose")
      ->check(CLI::IsMember({"z", "y"}))
      ->capture_default_str();
  verb->add_option("--color", request->color,
                   "Of the surfaces: the scan's where it has any, or by kind")
      ->check(CLI::IsMember({"scan", "kind"}))
      ->capture_default_str();
  verb->add_flag("--merge", options.merge, "All that is seen in one mesh");
  verb->add_flag("--physics", options.physics,
                 "glTF: with colliders (KHR_physics_rigid_bodies, a draft)");
  verb->add_option("--resolution", options.resolution, "Edge of the cells of grids and maps [m]")
      ->check(CLI::Range(1e-3, 1e3))
      ->capture_default_str();
  verb->add_flag("--open-glass", options.open_glass,
                 "Grids and maps: panes of glass are no obstacles, as to a lidar");
  verb->add_option(
          "--poses", request->poses,
          "Grids of scans: scanner positions, one a line, that a property scan_index of the "
          "points counts from 0")
      ->type_name("F");
  verb->add_option("--min-points", options.min_points,
                   "Grids of scans: cells with fewer points have none")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("--band", request->band,
                   "Heights over the floor between which things are in a robot's way [m]")
      ->expected(2)
      ->type_name("LOW HIGH")
      ->capture_default_str();
  verb->add_option("--storey", options.storey,
                   "Of maps of one: 0 for the lowest; where it is not given, that of the largest "
                   "floor")
      ->check(CLI::Range(0, 1000));
  verb->add_option("--budget", request->budget,
                   "Most that the engine takes: faces=N,solids=N,hulls=N,hull_vertices=N")
      ->type_name("CAPS");
  verb->add_flag("-q,--quiet", request->console.quiet, "No warnings");
  verb->footer(footer());
  verb->callback([request] { run(*request); });
}

}  // namespace scanworld::cli
