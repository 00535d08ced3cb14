// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "budget.h"
#include "cli.h"
#include "error.h"
#include "exporters/export.h"
#include "facets.h"
#include "fidelity.h"
#include "files.h"
#include "output_folder.h"
#include "parallel.h"
#include "report_json.h"
#include "scan/read_scan.h"
#include "scan/write_scan.h"
#include "settings.h"
#include "view.h"
#include "viewer/replay_json.h"
#include "viewer/report_page.h"
#include "world/world_json.h"

namespace scanworld::cli {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kBuildExample = R"(Example:
  scanworld build office.ply -o office
writes office/world.json, report.json, world.obj, world.stl, world.glb and world.bullet.

'scanworld build --options' lists what can be set with --set and --config.)";

struct BuildRequest {
  std::vector<std::filesystem::path> scans;
  std::filesystem::path out, config, poses;
  std::string budget, sagitta, floor_tolerance, unknown;
  std::string method = "rival", preset;  // an empty preset: the one that suits the scan
  std::vector<std::string> assignments, exports = {"obj", "stl", "glb", "bullet"};
  int threads = 0;
  std::uint64_t seed = 1;
  bool labels = false, json = false, show_options = false;
  bool record = false, view = false;
  bool level = false, floor_at_zero = false;
  Console console;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

ReconstructOptions resolve_options(const BuildRequest& request) {
  ReconstructOptions options{.method = method_named(request.method)};
  apply_preset(options, request.preset.empty() ? "indoor" : request.preset);
  if (!request.config.empty()) apply_config(options, request.config);
  apply_assignments(options, request.assignments);
  if (!request.unknown.empty()) {
    options.space.unknown = space::unknown_named(request.unknown);
    if (options.method == Method::thesis || !options.space.is_on)
      throw Error(Cause::usage,
                  "--unknown: surfaces found plane by plane know no unknown space (space.on)");
  }
  if (!request.floor_tolerance.empty())
    options.floor_tolerance = length_from("--floor-tolerance", request.floor_tolerance);
  options.record = request.record;
  options.frame.level |= request.level, options.frame.floor_at_zero |= request.floor_at_zero;
  return options;
}

// The formats that the world is to be written in; throws usage for one that does not exist.
std::vector<ExportFormat> resolve_exports(const BuildRequest& request) {
  std::vector<ExportFormat> formats;
  for (const std::string& name : request.exports)
    if (name != "none" && name != "json") formats.push_back(export_format("--export", name));
  return formats;
}

std::vector<std::string> warnings_about(const PointCloud& cloud, const World& world,
                                        const LevelOptions& asked) {
  std::vector<std::string> warnings;
  if (!cloud.skipped.empty())
    warnings.push_back(fmt::format(
        "{} of {} points are not finite and were left out (the first is point {})",
        grouped(cloud.skipped.size()), grouped(cloud.input_size()), cloud.skipped[0] + 1));
  if (const double tilt = tilt_of(world.frame) * 180 / M_PI; tilt > 0)
    warnings.push_back(
        cloud.camera_frame
            ? fmt::format("the scan is in its camera's frame, where up is {:.1f} degrees off +z; "
                          "--level makes it upright",
                          tilt)
            : fmt::format("the scan is tilted by {:.1f} degrees; --level makes it upright", tilt));
  if (asked.floor_at_zero && !main_floor(world))
    warnings.push_back("no floor was found that could be put at z = 0");
  return warnings;
}

void add_provenance(World& world, const BuildRequest& request, const PointCloud& cloud) {
  // The points of several files are one set; it is named by the files in the order of the alphabet.
  std::vector<std::string> names;
  for (const auto& scan : request.scans) names.push_back(scan.filename().string());
  std::sort(names.begin(), names.end());
  world.provenance.inputs.push_back(
      {fmt::format("{}", fmt::join(names, ", ")), cloud.points.size(), fingerprint(cloud)});
  world.provenance.options["preset"] = request.preset;
  world.provenance.options["seed"] = static_cast<std::int64_t>(request.seed);
}

void write_json(const std::filesystem::path& path, const Json& json) {
  write_text(path, json.dump(2) + "\n");
}

std::string summary(const BuildRequest& request, const World& world, const Json& report) {
  const auto count = [&](const char* kind) { return report["surfaces"][kind].get<std::size_t>(); };
  return fmt::format(
      "{}: {} surfaces ({} floor, {} ceiling, {} wall, {} other) and {} triangles from {} points "
      "in {:.2f} s",
      request.out.string(), world.surfaces.size(), count("floor"), count("ceiling"), count("wall"),
      count("other"), report["triangles"].get<std::size_t>(),
      grouped(report["points"]["input"].get<std::size_t>()),
      report["complete_seconds"].get<double>());
}

// Writes all files of the world into the folder.
void write_files(const std::filesystem::path& folder, const BuildRequest& request,
                 const std::vector<ExportFormat>& formats, const PointCloud& cloud,
                 const ReconstructResult& result, const std::string& replay) {
  write_world(folder / "world.json", result.world);
  const ExportOptions options{.sagitta = sagitta_from(request.sagitta)};
  const World prepared =
      formats.empty()
          ? World{}
          : prepare_export(cut_anew(result.world, options.sagitta, request.console), options);
  for (const ExportFormat& format : formats)
    format.write(folder / ("world." + format.extension), prepared, options);
  if (request.labels) write_labels(folder / "labels.ply", cloud, result.labels);
  if (!replay.empty()) write_text(folder / "replay.json", replay);
}

Json whole_report(const BuildRequest& request, const ReconstructResult& result,
                  const Fidelity& fidelity, const PointCloud& cloud, double seconds) {
  Json report = report_json(result, fidelity, cloud);
  report["scans"] = Json::array();
  for (const auto& scan : request.scans) report["scans"].push_back(scan.string());
  report["method"] = request.method;
  if (!request.unknown.empty()) report["unknown"] = request.unknown;
  report["preset"] = request.preset;
  report["complete_seconds"] = seconds;
  return report;
}

void write_view(const std::filesystem::path& file, const BuildRequest& request,
                const ReconstructResult& result, const PointCloud& cloud, const Json& report,
                const std::string& replay) {
  PageContent content{.title = folder_name(request.out), .world = result.world};
  content.scan = scan_view(result.world, cloud);
  content.report = report.dump();
  content.replay = replay;
  write_text(file, page_of(content));
}

// Says what was done: warnings and stages on stderr, the result on stdout.
void tell(const BuildRequest& request, const ReconstructResult& result, const Json& report) {
  request.console.finish_progress();
  for (const std::string& warning : result.report.warnings) request.console.warn(warning);
  for (const StageReport& s : result.report.stages)
    request.console.note(fmt::format("{:<28} {:8.1f} ms  {:>11} -> {:<9} {}", s.name,
                                     1e3 * s.seconds, grouped(s.in), grouped(s.out), s.what));
  if (request.json)
    print_json(report);
  else
    fmt::print("{}\n{}\n", summary(request, result.world, report),
               "the world is " + report["fidelity"]["verdict"].get<std::string>());
}

void run(BuildRequest request) {
  if (request.show_options) return fmt::print("{}", options_table());
  if (request.scans.empty() || request.out.empty())
    throw Error(Cause::usage, "build needs a SCAN and -o DIR (see --help)");
  const auto start = Clock::now();
  // All that can be wrong about the request is found before a large file is read.
  ReconstructOptions options = resolve_options(request);
  const std::vector<ExportFormat> formats = resolve_exports(request);
  sagitta_from(request.sagitta);
  const double limit = request.budget.empty() ? 0 : seconds_from(request.budget);
  const std::vector<Vec3> poses =
      request.poses.empty() ? std::vector<Vec3>{} : read_poses(request.poses);
  std::vector<std::filesystem::path> inputs = request.scans;
  inputs.insert(inputs.end(), {request.config, request.poses});
  OutputFolder folder(request.out, "world.json", inputs);
  const ThreadLimit threads(request.threads);
  const Progress progress = request.console.make_progress();

  Report reading;
  PointCloud cloud =
      StageLog(reading, progress, 1).run("Reading", "files -> points", request.scans, [&] {
        return read_scan(request.scans, poses);
      });
  if (request.preset.empty()) {
    request.preset = preset_for(cloud);
    options = resolve_options(request);
  }

  ReconstructResult result = reconstruct(cloud, options, progress);
  std::vector<StageReport>& stages = result.report.stages;
  stages.insert(stages.begin(), reading.stages[0]);
  const std::vector<std::string> warnings = warnings_about(cloud, result.world, options.frame);
  result.report.warnings.insert(result.report.warnings.begin(), warnings.begin(), warnings.end());
  add_provenance(result.world, request, cloud);

  StageLog log(result.report, progress, stages.size() + (limit > 0 ? 3 : 2));
  std::optional<sim::Budget> budget;
  if (limit > 0)
    budget = log.run("Meeting the budget", "solids -> solids", result.world.colliders,
                     [&] { return keep_budget(result, limit); });
  const Fidelity fidelity = log.run("Checking fidelity", "points -> criteria", cloud,
                                    [&] { return fidelity_of(result.world, cloud); });
  const std::string replay = result.replay ? replay_text(*result.replay) : "";
  log.run("Writing", "surfaces -> files", result.world.surfaces, [&] {
    write_files(folder.path(), request, formats, cloud, result, replay);
    return formats.size() + 1 + request.labels;
  });
  Json report = whole_report(request, result, fidelity, cloud, seconds_since(start));
  if (budget) report["budget"] = json_of(*budget);
  if (!fidelity.is_faithful()) report["warnings"].push_back("the world is " + verdict_of(fidelity));
  write_json(folder.path() / "report.json", report);
  write_text(folder.path() / "report.html",
             report_page_of(result.world, folder_name(request.out), report.dump()));
  if (request.view) write_view(folder.path() / "view.html", request, result, cloud, report, replay);
  const std::vector<std::string> kept = folder.commit();
  tell(request, result, report);
  for (const std::string& file : kept) request.console.warn(file);
}

}  // namespace

void add_build(CLI::App& app) {
  auto request = std::make_shared<BuildRequest>();
  CLI::App* verb = app.add_subcommand("build", "Make a world of a scan");
  verb->add_option("scans", request->scans,
                   "Scan files of one place: PLY, PCD, XYZ, TXT, CSV, PTS (text also .gz)")
      ->type_name("SCAN");
  verb->add_option("-o,--out", request->out, "Folder to write; appears whole or not at all")
      ->type_name("DIR");
  verb->add_option("--method", request->method,
                   "rival: clusters compete for voxels; thesis: the method of 2012")
      ->check(CLI::IsMember({"rival", "thesis"}))
      ->capture_default_str();
  verb->add_option("--preset", request->preset, "Options for a kind of scan")
      ->check(CLI::IsMember(preset_names()))
      ->default_str("rgbd for a depth camera's image, else indoor");
  verb->add_option("--config", request->config, "TOML file with options")->type_name("F.toml");
  verb->add_option("--set", request->assignments, "Set one option; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  verb->add_flag("--options", request->show_options,
                 "List all options with default, unit and meaning");
  verb->add_option("--budget", request->budget,
                   "Mean time that a contact test in Bullet may take here: 5us; simplifies until "
                   "it does")
      ->type_name("TIME");
  verb->add_option("--poses", request->poses, kPosesHelp)->type_name("F");
  verb->add_option("--threads", request->threads, "Threads to use; 0 = all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  verb->add_flag("--level", request->level,
                 "Turn the world upright, so that up is +z; without it stays as it was scanned");
  verb->add_flag("--floor-at-zero", request->floor_at_zero,
                 "Move the world along up so that its largest floor is at height 0 (z = 0, with "
                 "--level)");
  verb->add_option("--floor-tolerance", request->floor_tolerance,
                   "What lies no higher on a floor is that floor, as carpets are: 2cm")
      ->type_name("LENGTH");
  verb->add_option("--unknown", request->unknown,
                   "What becomes of space that nobody saw: solid, free or open; without it, it is "
                   "solid behind surfaces and open elsewhere")
      ->type_name("WHAT");
  verb->add_flag("--labels", request->labels,
                 "Also write labels.ply: the surface of each input point");
  verb->add_flag("--record", request->record,
                 "Also write replay.json: how the method found its planes, for the page");
  verb->add_flag("--view", request->view,
                 "Also write view.html: a page that shows the world and the scan (see view)");
  verb->add_option("--export", request->exports, "Formats to write beside world.json, or none")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  add_sagitta(*verb, request->sagitta);
  verb->add_option("--seed", request->seed,
                   "For methods that draw random numbers (none does so far)")
      ->capture_default_str();
  verb->add_flag("--json", request->json, "Print the report to stdout");
  request->console.add_to(*verb);
  verb->footer(kBuildExample);
  verb->callback([request] { run(*request); });
}

}  // namespace scanworld::cli
