// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli.h"
#include "error.h"
#include "exporters/assimp.h"
#include "fidelity.h"
#include "scan/read_scan.h"
#include "world/level.h"
#include "world/world_json.h"

namespace scanworld::cli {

namespace {

using cli::json_of;

Json json_of(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }

// The world in the coordinates of its scan but for the origin.
World as_scanned(const World& world) { return moved(world, world.frame.rotation, Vec3::Zero()); }

Json box_json(const Box3& box, const Vec3& origin) {
  if (box.isEmpty()) return nullptr;
  return {{"min", json_of(box.min() + origin)},
          {"max", json_of(box.max() + origin)},
          {"size", json_of(box.sizes())}};
}

// How many points know their viewpoint.
std::size_t count_knowing(const PointCloud& cloud) {
  if (!cloud.viewers.empty())
    return static_cast<std::size_t>(
        std::ranges::count_if(cloud.viewers, [](std::int32_t v) { return v >= 0; }));
  return cloud.viewpoints.size() == 1 ? cloud.points.size() : 0;
}

Json scan_info(const std::filesystem::path& file, const std::filesystem::path& poses) {
  const PointCloud cloud = read_scan_with_poses({file}, poses);
  Box3 box;
  for (const Vec3f& p : cloud.points) box.extend(p.cast<double>());
  Json viewpoints = Json::array();
  for (const Vec3& v : cloud.viewpoints) viewpoints.push_back(json_of(v + cloud.origin));
  return {{"file", file.string()},
          {"is", "scan"},
          {"format", scan_format(file)},
          {"points", cloud.points.size()},
          {"not_finite", cloud.skipped.size()},
          {"bounds", box_json(box, cloud.origin)},
          {"origin", json_of(cloud.origin)},
          {"normals", !cloud.normals.empty()},
          {"colors", !cloud.colors.empty()},
          {"viewpoints", viewpoints},
          {"scan_index", has_scan_index(file)},
          {"with_viewpoint", count_knowing(cloud)},
          {"camera_image", cloud.camera_frame},
          {"fingerprint", fingerprint(cloud)}};
}

Json mesh_info(const std::filesystem::path& file) {
  const Mesh mesh = read_mesh(file);
  Box3 box;
  double area = 0;
  for (const Vec3& v : mesh.vertices) box.extend(v);
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    area += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
  }
  return {{"file", file.string()},
          {"is", "mesh"},
          {"triangles", mesh.triangles.size()},
          {"vertices", mesh.vertices.size()},
          {"area", area},
          {"bounds", box_json(box, Vec3::Zero())}};
}

Json world_info(const std::filesystem::path& file) {
  const World world = read_valid_world(file);
  double total = 0;
  for (const Surface& s : world.surfaces) total += area(world, s);
  Json inputs = Json::array();
  for (const auto& input : world.provenance.inputs) inputs.push_back(input.file);
  return {{"file", file.string()},
          {"is", "world"},
          {"surfaces", kind_counts(world)},
          {"vertices", world.vertices.size()},
          {"openings", world.openings.size()},
          {"obstacles", world.obstacles.size()},
          {"colliders", world.colliders.size()},
          {"rooms", world.rooms.size()},
          {"ways", world.ways.size()},
          {"area", total},
          {"bounds", box_json(bounds(as_scanned(world)), world.frame.origin)},
          {"own_bounds", box_json(bounds(world), Vec3::Zero())},
          {"origin", json_of(world.frame.origin)},
          {"rotation", json_of(world.frame.rotation)},
          {"up", json_of(world.frame.up)},
          {"tilt_degrees", tilt_of(world.frame) * 180 / M_PI},
          {"assumed", world.frame.assumed},
          {"made_by", world.provenance.program},
          {"made_from", inputs},
          {"world_hash", world_hash(world)}};
}

// One line a value; nested objects as "a 1, b 2".
std::string as_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.3f}", value.get<double>());
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_null()) return "none";
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& item : value.items()) {
    const char* between = value.is_object() ? ", " : item.value().is_number() ? " " : "; ";
    text += (text.empty() ? "" : between) + (value.is_object() ? item.key() + " " : "") +
            as_text(item.value());
  }
  return text.empty() ? "none" : text;
}

void run(const std::filesystem::path& file, const std::filesystem::path& poses, bool json) {
  if (!poses.empty() && kind_of(file) != FileKind::scan)
    throw Error(Cause::usage, poses.string() + ": --poses goes with a scan");
  Json info;
  switch (kind_of(file)) {
    case FileKind::scan:
      info = scan_info(file, poses);
      break;
    case FileKind::mesh:
      info = mesh_info(file);
      break;
    case FileKind::world:
      info = world_info(file);
      break;
  }
  if (json) return print_json(info);
  for (const auto& item : info.items()) {
    std::string name = item.key();
    std::replace(name.begin(), name.end(), '_', ' ');
    fmt::print("{:<14} {}\n", name, as_text(item.value()));
  }
}

}  // namespace

void add_info(CLI::App& app) {
  struct InfoRequest {
    std::filesystem::path file, poses;
    bool json = false;
  };
  auto request = std::make_shared<InfoRequest>();
  CLI::App* verb = app.add_subcommand("info", "Tell what is in a scan, mesh or world");
  verb->add_option("file", request->file, "A scan, a mesh, a world.json or its folder")
      ->required()
      ->type_name("FILE");
  verb->add_option("--poses", request->poses, kPosesHelp)->type_name("F");
  verb->add_flag("--json", request->json, "As JSON");
  verb->footer("Example:\n  scanworld info office.ply");
  verb->callback([request] { run(request->file, request->poses, request->json); });
}

}  // namespace scanworld::cli
