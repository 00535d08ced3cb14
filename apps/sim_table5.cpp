// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The comparison of Table 5 of V. Petrik's thesis of 2012, made anew on any scan: dense meshes by
// the methods of its time, and worlds, in one engine.
#include <fmt/format.h>

#include <memory>

#include "cli.h"
#include "error.h"
#include "exporters/ply.h"
#include "fidelity.h"
#include "files.h"
#include "output_folder.h"
#include "reconstruct.h"
#include "sim_check.h"
#include "sim_check/baselines/baselines.h"
#include "sim_check/report.h"
#include "world/solids.h"
#include "world/world_json.h"

namespace scanworld::cli {

namespace {

struct Table5Request {
  std::vector<std::filesystem::path> scans;
  std::filesystem::path poses, out;
  sim::BaselineOptions baseline;
  MeasureRequest measure;
  Console console;
};

// What a method made of the scan.
struct Entry {
  std::string name;
  double seconds = 0;
  World world;  // of a mesh one of a surface a triangle, to measure how true it is
  Mesh mesh;    // of a baseline
  Fidelity fidelity;
};

// Each triangle is a surface.
World world_of(const Mesh& mesh) {
  World world;
  world.vertices = mesh.vertices;
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 normal = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
    if (normal.norm() < 1e-10) continue;
    world.surfaces.push_back({.id = static_cast<int>(world.surfaces.size()),
                              .plane = plane_through(a, normal.normalized()),
                              .outer = {t[0], t[1], t[2]}});
  }
  return world;
}

std::vector<Entry> make_entries(const Table5Request& request, const PointCloud& cloud,
                                const Progress& progress) {
  std::vector<Entry> entries;
  const auto add = [&](const std::string& name, auto make) {
    const auto share = static_cast<double>(entries.size()) / 10;
    if (progress) progress("making " + name, share);
    Entry entry{.name = name};
    const sim::Stopwatch watch;
    make(entry);
    entry.seconds = watch.wall();
    if (!entry.mesh.triangles.empty()) entry.world = world_of(entry.mesh);
    entry.fidelity = fidelity_of(entry.world, cloud);
    entries.push_back(std::move(entry));
  };
  for (const sim::Baseline& baseline : sim::baselines())
    add(baseline.name,
        [&](Entry& entry) { entry.mesh = baseline.make(cloud, request.baseline, {}); });
  for (Method method : {Method::thesis, Method::rival})
    add(name_of(method), [&](Entry& entry) {
      ReconstructOptions options{.method = method};
      apply_preset(options, preset_for(cloud));
      entry.world = reconstruct(cloud, options).world;
    });
  return entries;
}

std::vector<sim::Place> places_of(const std::vector<Entry>& entries) {
  std::vector<sim::Place> places;
  for (const Entry& entry : entries)
    if (!entry.mesh.triangles.empty()) {
      places.push_back(sim::place_of(entry.name, entry.mesh));
    } else {
      places.push_back(sim::place_of(entry.name + ", triangles", entry.world, {.as_mesh = true}));
      places.push_back(sim::place_of(entry.name + ", solids", entry.world));
    }
  return places;
}

std::string millimetres(double metres) { return fmt::format("{:.1f}", 1e3 * metres); }

// How true and how fast each is, a row a place.
std::string summary(const std::vector<Entry>& entries, const sim::Comparison& comparison) {
  std::string text =
      "| method | made in s | triangles | per m2 | scan to it, mm: median | 95 % | it to scan, mm: "
      "95 % | unexplained | detection ms | x gg | x gsrm | step ms | x gg | x gsrm |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | "
      "---: |\n";
  const auto cubes = [](const sim::Row& row) -> const sim::Timing& {
    const sim::StepSpeed* last = nullptr;
    for (const sim::StepSpeed& step : row.speed.steps)
      if (step.kind == sim::RobotKind::cube) last = &step;
    return last->time;
  };
  const sim::Row& gsrm = comparison.rows[1];
  for (const sim::Row& row : comparison.rows) {
    const auto entry = std::ranges::find_if(
        entries, [&](const Entry& e) { return row.name.substr(0, row.name.find(',')) == e.name; });
    text += fmt::format("| {} | ", row.name);
    if (entry == entries.end()) {
      text += "- | - | - | - | - | - | - | ";
    } else {
      const Fidelity& f = entry->fidelity;
      text += fmt::format("{:.2f} | {} | {:.1f} | {} | {} | {} | {:.1f} % | ", entry->seconds,
                          row.speed.triangles,
                          static_cast<double>(row.speed.triangles) / row.speed.area,
                          millimetres(f.scan_to_world.median), millimetres(f.scan_to_world.p95),
                          millimetres(f.world_to_scan.p95), 100 * f.unexplained);
    }
    const sim::Timing &collide = row.speed.collide, &step = cubes(row);
    text +=
        fmt::format("{:.3f} | {:.1f} | {:.1f} | {:.3f} | {:.1f} | {:.1f} |\n",
                    1e3 * collide.cpu.mean, collide.ratio, collide.ratio / gsrm.speed.collide.ratio,
                    1e3 * step.cpu.mean, step.ratio, step.ratio / cubes(gsrm).ratio);
  }
  return text;
}

constexpr const char* kAbout = R"(
The comparison of Table 5 of V. Petrik's thesis (2012), in kind: there the Symbrion simulator took 333 +- 125 ms
with a mesh of Growing Grid, 115 +- 43 ms with one of GSRM and 2.5 +- 0.5 ms with the thesis' polygons, 133 and 46
times less. Its robots, step and machine are not known, so its milliseconds are not reproduced, only its comparison.
Detection is of robots at the same poses everywhere; a step is one of simulation. Times are CPU time, means.

)";

void write_folder(const std::filesystem::path& folder, const std::vector<Entry>& entries,
                  const sim::Comparison& comparison, const std::string& table) {
  write_text(folder / "table5.md", table);
  write_comparison(folder, comparison);
  for (const Entry& entry : entries)
    if (!entry.mesh.triangles.empty()) {
      write_ply_mesh(folder / (entry.name + ".ply"), entry.mesh);
    } else {
      std::filesystem::create_directory(folder / entry.name);
      write_world(folder / entry.name / "world.json", entry.world);
    }
}

void run(const Table5Request& request) {
  const sim::CompareOptions options = request.measure.resolved();
  if (!options.with_speed)
    throw Error(Cause::usage, "table5 is about speed; --only robustness leaves nothing of it");
  std::vector<std::filesystem::path> inputs = request.scans;
  inputs.push_back(request.poses);
  OutputFolder folder(request.out, "table5.md", inputs);
  const Progress progress = request.console.make_progress();
  const PointCloud cloud = read_scan_with_poses(request.scans, request.poses);
  const std::vector<Entry> entries = make_entries(request, cloud, progress);
  const Progress rest = [&](std::string_view what, double share) {
    if (progress) progress(what, 0.5 + share / 2);
  };
  const sim::Comparison comparison = sim::compare(places_of(entries), nullptr, options, rest);
  request.console.finish_progress();
  const std::string table =
      fmt::format("# Table 5 on {}, {} points\n", request.scans[0].filename().string(),
                  grouped(cloud.points.size())) +
      kAbout + summary(entries, comparison);
  write_folder(folder.path(), entries, comparison, table);
  const std::vector<std::string> kept = folder.commit();
  fmt::print("{}", table);
  for (const std::string& noise : comparison.noise)
    request.console.warn("the machine was too noisy to judge: " + noise);
  for (const std::string& file : kept) request.console.warn(file);
}

}  // namespace

void add_table5(CLI::App& app) {
  auto request = std::make_shared<Table5Request>();
  CLI::App* verb = app.add_subcommand(
      "table5", "Make dense meshes and worlds of a scan, and compare how fast and true they are");
  verb->add_option("scans", request->scans, "Scan files of one place")
      ->required()
      ->type_name("SCAN");
  verb->add_option("-o,--out", request->out, "Folder to write")->required()->type_name("DIR");
  verb->add_option("--poses", request->poses, kPosesHelp)->type_name("F");
  verb->add_option("--nodes", request->baseline.nodes, "Of the dense meshes")
      ->check(CLI::Range(4, 1000000))
      ->capture_default_str();
  request->measure.add_to(*verb);
  request->console.add_to(*verb);
  verb->footer("Example:\n  sim_check table5 office.ply -o table5");
  verb->callback([request] { run(*request); });
}

}  // namespace scanworld::cli
