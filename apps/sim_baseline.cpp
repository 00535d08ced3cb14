// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli.h"
#include "error.h"
#include "exporters/ply.h"
#include "files.h"
#include "scan/read_scan.h"
#include "sim_check.h"
#include "sim_check/baselines/baselines.h"
#include "sim_check/baselines/tessellate.h"
#include "sim_check/place.h"
#include "sim_check/timing.h"

namespace scanworld::cli {

namespace {

struct BaselineRequest {
  std::string method;
  std::vector<std::filesystem::path> scans;
  std::filesystem::path out;
  sim::BaselineOptions options;
  Console console;
};

struct TessellateRequest {
  std::filesystem::path place, out;
  sim::TessellateOptions options;
};

void check_ply(const std::filesystem::path& out, const std::vector<std::filesystem::path>& inputs) {
  if (lower_extension(out) != ".ply")
    throw Error(Cause::usage, out.string() + ": meshes are written as .ply");
  check_output(out, inputs);
}

void run(const BaselineRequest& request) {
  const sim::Baseline& baseline = sim::baseline_named(request.method);
  check_ply(request.out, request.scans);
  const Progress progress = request.console.make_progress();
  const PointCloud cloud = read_scan(request.scans);
  const sim::Stopwatch watch;
  const Mesh mesh = baseline.make(cloud, request.options, progress);
  const double seconds = watch.wall();
  request.console.finish_progress();
  write_ply_mesh(request.out, mesh);
  fmt::print("{}: {} vertices and {} triangles from {} points in {:.2f} s\n", request.out.string(),
             mesh.vertices.size(), mesh.triangles.size(), grouped(cloud.points.size()), seconds);
}

void run(const TessellateRequest& request) {
  check_ply(request.out, {request.place});
  const sim::Place place = sim::read_place(request.place);
  const Mesh mesh = sim::tessellate(place.seen, request.options);
  write_ply_mesh(request.out, mesh);
  fmt::print("{}: {} vertices and {} triangles\n", request.out.string(), mesh.vertices.size(),
             mesh.triangles.size());
}

}  // namespace

void add_baseline(CLI::App& app) {
  auto request = std::make_shared<BaselineRequest>();
  CLI::App* verb =
      app.add_subcommand("baseline", "Make a dense mesh of a scan by a method of others");
  std::string methods;
  for (const sim::Baseline& baseline : sim::baselines())
    methods += fmt::format("\n  {:<6}{}", baseline.name, baseline.describes);
  verb->add_option("method", request->method, "One of:" + methods)->required();
  verb->add_option("scans", request->scans, "Scan files of one place")
      ->required()
      ->type_name("SCAN");
  verb->add_option("-o,--out", request->out, "PLY file to write")->required()->type_name("F.ply");
  verb->add_option("--nodes", request->options.nodes, "Vertices that the mesh has, about")
      ->check(CLI::Range(4, 1000000))
      ->capture_default_str();
  verb->add_option("--seed", request->options.seed, "Another seed, another mesh")
      ->capture_default_str();
  request->console.add_to(*verb);
  verb->footer("Example:\n  sim_check baseline gsrm office.ply -o gsrm.ply --nodes 5000");
  verb->callback([request] { run(*request); });
}

void add_tessellate(CLI::App& app) {
  auto request = std::make_shared<TessellateRequest>();
  CLI::App* verb = app.add_subcommand(
      "tessellate", "Make a dense, uneven mesh of a world, as good as one of a scan could be");
  verb->add_option("place", request->place, "A world or a mesh")
      ->required()
      ->type_name("WORLD_OR_MESH");
  verb->add_option("-o,--out", request->out, "PLY file to write")->required()->type_name("F.ply");
  verb->add_option("--triangles", request->options.triangles, "At least so many")
      ->capture_default_str();
  verb->add_option("--noise", request->options.noise,
                   "Standard deviation of the vertices along their normals [m]")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  verb->add_option("--seed", request->options.seed, "Another seed, other noise")
      ->capture_default_str();
  verb->footer("Example:\n  sim_check tessellate worlds/office.json -o dense.ply");
  verb->callback([request] { run(*request); });
}

}  // namespace scanworld::cli
