// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli.h"
#include "files.h"
#include "parallel.h"
#include "scan/read_scan.h"
#include "scan/write_scan.h"
#include "world/virtual_scan.h"
#include "world/world_json.h"

namespace scanworld::cli {

namespace {

constexpr double kDegree = M_PI / 180;

struct ScanRequest {
  std::filesystem::path world, out, poses, save_poses;
  VirtualScanOptions options;
  double resolution_degrees = VirtualScanOptions{}.resolution / kDegree;
  double lowest_degrees = VirtualScanOptions{}.lowest / kDegree;
  int threads = 0;
  bool labels = false;
};

std::filesystem::path labels_path(const std::filesystem::path& scan) {
  return std::filesystem::path(scan).replace_extension(".labels.ply");
}

void write_poses(const std::filesystem::path& path, const PointCloud& cloud) {
  OutputFile file(path);
  for (const Vec3& v : cloud.viewpoints) {
    const Vec3 pose = v + cloud.origin;
    file.write(fmt::format("{} {} {}\n", pose.x(), pose.y(), pose.z()));
  }
  file.commit();
}

// Before anything is read, that nothing which is there comes to harm.
void check_outputs(const ScanRequest& request) {
  const std::vector<std::filesystem::path> inputs = {world_file(request.world), request.poses};
  check_output(request.out, inputs);
  if (request.labels) {
    check_output(labels_path(request.out), inputs);
    check_replaces_own(labels_path(request.out), "property int plane_id");
  }
  if (!request.save_poses.empty()) check_output(request.save_poses, inputs);
}

void run(ScanRequest request) {
  check_outputs(request);
  const ThreadLimit threads(request.threads);
  const World world = read_valid_world(request.world);
  request.options.resolution = request.resolution_degrees * kDegree;
  request.options.lowest = request.lowest_degrees * kDegree;
  if (!request.poses.empty())
    for (const Vec3& pose : read_poses(request.poses))
      request.options.poses.push_back(world.frame.to_world(pose));
  const VirtualScan scan = virtual_scan(world, request.options);
  // Indices say something only beside the poses that they count.
  write_scan(request.out, scan.cloud,
             request.save_poses.empty() ? std::vector<ExtraColumn>{}
                                        : std::vector<ExtraColumn>{{kScanIndex, scan.pose}});
  if (request.labels)
    write_scan(labels_path(request.out), scan.cloud,
               {{"plane_id", scan.surface}, {"kind", scan.kind}, {"pose", scan.pose}});
  if (!request.save_poses.empty()) write_poses(request.save_poses, scan.cloud);
  fmt::print("{}: {} points from {} poses\n", request.out.string(),
             grouped(scan.cloud.points.size()), scan.cloud.viewpoints.size());
}

}  // namespace

void add_scan(CLI::App& app) {
  auto request = std::make_shared<ScanRequest>();
  VirtualScanOptions& o = request->options;
  CLI::App* verb =
      app.add_subcommand("scan", "Scan a world as a laser scanner would (a virtual scanner)");
  verb->add_option("world", request->world, "A world.json or its folder")
      ->required()
      ->type_name("WORLD");
  verb->add_option("-o,--out", request->out, "Scan to write: .ply, .xyz or .txt")
      ->required()
      ->type_name("SCAN");
  verb->add_option("--poses", request->poses,
                   "Scanner positions, one a line; without: they are chosen so as to see all over "
                   "the floors")
      ->type_name("F");
  verb->add_option(
          "--save-poses", request->save_poses,
          "Write the positions that were used; the points then have their number, from 0, as "
          "scan_index")
      ->type_name("F");
  verb->add_option("--points", o.points, "Number of points; 0 = as the resolution gives")
      ->capture_default_str();
  verb->add_option("--resolution", request->resolution_degrees, "Degrees between neighbouring rays")
      ->capture_default_str();
  verb->add_option("--lowest", request->lowest_degrees, "Elevation in degrees that is seen down to")
      ->capture_default_str();
  verb->add_option("--max-range", o.max_range, "Farthest return [m]")->capture_default_str();
  verb->add_option("--noise", o.noise, "Standard deviation of a range [m]")->capture_default_str();
  verb->add_option("--outliers", o.outliers, "Share of stray points")->capture_default_str();
  verb->add_option("--mixed", o.mixed, "Chance of a point between near and far at an edge")
      ->capture_default_str();
  verb->add_option("--seed", o.seed, "Another seed, other noise")->capture_default_str();
  verb->add_flag("--labels", request->labels,
                 "Also write SCAN.labels.ply: plane_id, kind (0 surface, 1 obstacle, 2 mixed, 3 "
                 "outlier) and pose");
  verb->add_option("--threads", request->threads, "Threads to use; 0 = all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  verb->footer(
      "Example:\n  scanworld scan worlds/office.json -o office.ply --points 300000 --noise 0.01");
  verb->callback([request] { run(*request); });
}

}  // namespace scanworld::cli
