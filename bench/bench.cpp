// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Times the stages of a reconstruction, and scores the planes found in scans of worlds. The world's
// hash shows whether two builds still make the same world; compare.py holds two against each other.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "error.h"
#include "measure.h"
#include "parallel.h"
#include "version.h"

namespace scanworld::bench {

namespace {

using Json = nlohmann::ordered_json;

struct Request {
  std::vector<std::filesystem::path> inputs;
  MeasureOptions options;
  std::string method = name_of(ReconstructOptions{}.method);
  std::vector<std::string> assignments;
  int threads = 0;
  bool json = false;
};

void add_options(CLI::App& app, Request& request) {
  MeasureOptions& o = request.options;
  app.add_option(
         "inputs", request.inputs,
         "Scan files, and worlds (world.json or its folder) to scan virtually; without: the "
         "worlds in worlds/")
      ->type_name("SCAN|WORLD");
  app.add_option("--runs", o.runs, "Runs of each, whose median times are told")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--points", o.scan.points, "Points of a world's scan; 0 = as the scanner gives")
      ->capture_default_str();
  app.add_option("--noise", o.scan.noise, "Standard deviation of a range in a world's scan [m]")
      ->capture_default_str();
  app.add_option("--seed", o.scan.seed, "Another seed, other noise")->capture_default_str();
  app.add_option("--method", request.method, "rival or thesis")
      ->check(CLI::IsMember({"rival", "thesis"}))
      ->capture_default_str();
  app.add_option("--set", request.assignments, "Set one option; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--threads", request.threads, "Threads to use; 0 = all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_flag("--json", request.json, "Print JSON");
}

void resolve_options(Request& request) {
  ReconstructOptions& options = request.options.reconstruct;
  options.method = method_named(request.method);
  for (const std::string& assignment : request.assignments)
    assign_option(list_options(options), assignment);
  if (request.inputs.empty())
    for (const char* name : {"room.json", "office.json", "stairs.json"})
      request.inputs.push_back(std::filesystem::path(SCANWORLD_SOURCE_DIR) / "worlds" / name);
}

Json json_of(const StageReport& s) {
  return {{"name", s.name}, {"seconds", s.seconds}, {"cpu_seconds", s.cpu_seconds},
          {"in", s.in},     {"out", s.out},         {"what", s.what}};
}

Json json_of(const PlaneScore& s) {
  return {{"asked_for", s.asked_for}, {"found", s.found}, {"precision", s.precision},
          {"recall", s.recall},       {"f1_50", s.f1_50}, {"f1_75", s.f1_75},
          {"mean_iou", s.mean_iou}};
}

Json json_of(const Measurement& m) {
  Json stages = Json::array();
  for (const StageReport& s : m.stages) stages.push_back(json_of(s));
  Json json = {
      {"input", m.input},          {"points", m.points},    {"fingerprint", m.fingerprint},
      {"stages", stages},          {"all", json_of(m.all)}, {"noise", m.noise},
      {"spacing", m.spacing},      {"scale", m.scale},      {"peak_memory_mb", m.peak_memory_mb},
      {"world_hash", m.world_hash}};
  if (m.score) json["score"] = json_of(*m.score);
  return json;
}

void print_row(const StageReport& s) {
  fmt::print("{:<28} {:>10.2f} {:>10.2f} {:>12} {:>12}\n", s.name, 1e3 * s.seconds,
             1e3 * s.cpu_seconds, s.in, s.out);
}

void print(const Measurement& m) {
  fmt::print("{}: {} points\n{:<28} {:>10} {:>10} {:>12} {:>12}\n", m.input, m.points, "stage",
             "ms", "CPU ms", "in", "out");
  for (const StageReport& s : m.stages) print_row(s);
  print_row(m.all);
  fmt::print("noise {:.1f} mm, spacing {:.1f} mm, scale {:.1f} mm, peak memory {:.0f} MB\n",
             1e3 * m.noise, 1e3 * m.spacing, 1e3 * m.scale, m.peak_memory_mb);
  if (m.score)
    fmt::print(
        "{} planes asked for, {} found: precision {:.3f}, recall {:.3f}, F1@0.5 {:.3f}, "
        "F1@0.75 {:.3f}, mean IoU {:.3f}\n",
        m.score->asked_for, m.score->found, m.score->precision, m.score->recall, m.score->f1_50,
        m.score->f1_75, m.score->mean_iou);
  fmt::print("world hash {}\n\n", m.world_hash);
  std::fflush(stdout);
}

void run(Request request) {
  resolve_options(request);
  const ThreadLimit threads(request.threads);
  Json inputs = Json::array();
  for (const std::filesystem::path& input : request.inputs) {
    const Measurement m = measure(input, request.options);
    if (request.json)
      inputs.push_back(json_of(m));
    else
      print(m);
  }
  if (request.json)
    fmt::print("{}\n", Json{{"program", std::string("scanworld ") + version()},
                            {"method", request.method},
                            {"runs", request.options.runs},
                            {"inputs", inputs}}
                           .dump(2));
}

int fail(Cause cause, const std::string& message) {
  fmt::print(stderr, "scanworld_bench: error: {}\n", message);
  return static_cast<int>(cause);
}

}  // namespace

}  // namespace scanworld::bench

int main(int argc, char** argv) {
  using namespace scanworld;
  CLI::App app("Times the stages of a reconstruction, and scores the planes found in worlds.",
               "scanworld_bench");
  bench::Request request;
  bench::add_options(app, request);
  try {
    app.parse(argc, argv);
    bench::run(request);
    return 0;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help
    return bench::fail(Cause::usage, std::string(e.what()) + " (see --help)");
  } catch (const Error& e) {
    return bench::fail(e.cause, e.what());
  } catch (const std::exception& e) {
    return bench::fail(Cause::failure, e.what());
  }
}
