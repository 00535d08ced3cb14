// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "export.h"

#include <fmt/format.h>

#include <algorithm>

#include "assimp.h"
#include "bullet.h"
#include "dot.h"
#include "error.h"
#include "gltf.h"
#include "graphml.h"
#include "grid.h"
#include "landmarks.h"
#include "map_server.h"
#include "mjcf.h"
#include "obj.h"
#include "octomap.h"
#include "output_folder.h"
#include "ply.h"
#include "sdf.h"
#include "stl.h"
#include "urdf.h"
#include "usda.h"
#include "world/world_json.h"

namespace scanworld {

namespace {

void write_json(const std::filesystem::path& path, const World& world, const ExportOptions&) {
  write_world(path, world);
}

template <OctreeKind kind>
void write_octree(const std::filesystem::path& path, const World& world,
                  const ExportOptions& options) {
  write_octomap(path, world, options, kind);
}

template <OctreeKind kind>
void write_scan_octree(const std::filesystem::path& path, const PointCloud& scan,
                       const ExportOptions& options) {
  write_scan_grid(path, scan, options, kind);
}

void check_fits(const ExportFormat& format, const std::filesystem::path& path,
                const ExportOptions& options) {
  if (options.y_up && !format.any_up)
    throw Error(Cause::usage, fmt::format("{}: {} has an up axis of its own; leave --up out",
                                          path.string(), format.name));
}

std::string readme(const std::vector<LeftOut>& left_out) {
  std::string text =
      "# A world by scanworld\n\nMetres, Z up but for world.glb, which is Y up as glTF demands. "
      "All files hold the same "
      "world, under the same names. Paths are relative: the folder can be moved.\n\n"
      "| file | what | how to load it |\n| --- | --- | --- |\n";
  for (const ExportFormat& f : export_formats()) {
    const auto is_this = [&](const LeftOut& l) { return l.format == f.name; };
    const std::string file = "world." + f.extension;
    if (const auto l = std::find_if(left_out.begin(), left_out.end(), is_this); l != left_out.end())
      text += fmt::format("| (no {}) | {} | left out: {} |\n", file, f.describes, l->why);
    else
      text += fmt::format("| {} | {} | {} |\n", file, f.describes,
                          fmt::format(fmt::runtime(f.loading), file));
  }
  return text;
}

}  // namespace

const std::vector<ExportFormat>& export_formats() {
  static const std::vector<ExportFormat> formats = {
      {"obj", "obj", "Wavefront OBJ with MTL, an object a surface",
       "any viewer or modeller: open {0}", write_obj, true},
      {"stl", "stl", "binary STL, triangles only", "any viewer, slicer or simulator: open {0}",
       write_stl, true},
      {"glb", "glb", "binary glTF 2.0, Y-up, a named node a surface",
       "Blender: File > Import > glTF; three.js: `new GLTFLoader().load('{0}')`", write_glb},
      {"ply", "ply", "binary PLY mesh, shared vertices, face colours and surface ids",
       "Open3D: `open3d.io.read_triangle_mesh('{0}')`", write_ply_mesh, true},
      {"dae", "dae", "Collada, by assimp", "any modeller: import {0}", write_dae},
      {"3mf", "3mf", "3MF, by assimp", "any slicer or modeller: open {0}", write_3mf},
      {"bullet", "bullet", "Bullet: a static body a solid, and a mesh for rays",
       "`btBulletWorldImporter(dynamics_world).loadFile(\"{0}\")`; PyBullet: `loadBullet('{0}')`",
       write_bullet},
      {"urdf", "urdf", "URDF of one link that stands still, with a folder of meshes",
       "PyBullet: `loadURDF('{0}', useFixedBase=True)`", write_urdf},
      {"sdf", "sdf", "SDF 1.7 for Gazebo: a world, and the folder of the model that it includes",
       "`GZ_SIM_RESOURCE_PATH=$PWD gz sim {0}` (Gazebo 11: `GAZEBO_MODEL_PATH=$PWD gazebo {0}`)",
       write_sdf},
      {"mjcf", "xml", "MJCF for MuJoCo: boxes and convex meshes",
       "`mujoco.MjModel.from_xml_path('{0}')`; in a model: `<include file=\"{0}\"/>`", write_mjcf},
      {"usda", "usda", "USD as text, with UsdPhysics colliders",
       "Isaac Sim, usdview: open {0}; in a stage: add it as a reference", write_usda, true},
      {"bt", "bt", "OctoMap, cells free, occupied or unknown; also of a scan",
       "`octovis {0}`; C++: `octomap::OcTree tree(\"{0}\")`; ROS: `rosrun octomap_server "
       "octomap_server_node {0}`",
       write_octree<OctreeKind::binary>, false, write_scan_octree<OctreeKind::binary>},
      {"ot", "ot", "OctoMap with the odds of each cell; also of a scan",
       "`octovis {0}`; C++: `octomap::AbstractOcTree::read(\"{0}\")`",
       write_octree<OctreeKind::log_odds>, false, write_scan_octree<OctreeKind::log_odds>},
      {"map_server", "yaml", "floor plan for map_server: YAML, and PGM beside it; also of a scan",
       "ROS 2: `ros2 run nav2_map_server map_server --ros-args -p yaml_filename:={0}`; ROS 1: "
       "`rosrun map_server map_server {0}`",
       write_map_server, false, write_scan_map},
      {"graphml", "graphml", "the map of rooms and doors as GraphML",
       "networkx: `networkx.read_graphml('{0}')`; yEd, Gephi: open {0}", write_graphml},
      {"dot", "dot", "the map of rooms and doors for Graphviz", "`neato -Tsvg {0} -o rooms.svg`",
       write_dot},
      {"landmarks", "landmarks.yaml", "corners and upright edges with their uncertainty",
       "`yaml.safe_load(open('{0}'))['landmarks']`", write_landmarks_yaml},
      {"csv", "landmarks.csv", "the same landmarks as a table", "`pandas.read_csv('{0}')`",
       write_landmarks_csv},
      {"json", "json", "the world itself, world.json", "`scanworld info {0}`", write_json, true},
  };
  return formats;
}

const ExportFormat& export_format(const std::filesystem::path& path, const std::string& name) {
  // "x.landmarks.yaml" is landmarks, though "x.yaml" is something else.
  const std::string last = lower_extension(path), both = lower_extension(path.stem()) + last;
  std::string names;
  for (const std::string& wanted : {"." + name, name.empty() ? both : "", name.empty() ? last : ""})
    for (const ExportFormat& f : export_formats())
      if (wanted == "." + f.name || wanted == "." + f.extension) return f;
  for (const ExportFormat& f : export_formats()) names += (names.empty() ? "" : ", ") + f.name;
  throw Error(Cause::usage,
              fmt::format("{}: '{}' is no export format; there are {}", path.string(),
                          name.empty() && !last.empty() ? last.substr(1) : name, names));
}

void export_world(const World& world, const std::filesystem::path& path,
                  const ExportOptions& options, const std::string& format) {
  const ExportFormat& chosen = export_format(path, format);
  check_fits(chosen, path, options);
  chosen.write(path, prepare_export(world, options), options);
}

const ExportFormat& scan_export_format(const std::filesystem::path& path, const std::string& name) {
  const ExportFormat& format = export_format(path, name);
  if (format.write_scan) return format;
  std::string names;
  for (const ExportFormat& f : export_formats())
    if (f.write_scan) names += (names.empty() ? "" : ", ") + f.name;
  throw Error(Cause::usage,
              fmt::format("{}: {} is made of a world; of a scan there are {} (build makes a world)",
                          path.string(), format.name, names));
}

void export_scan(const PointCloud& scan, const std::filesystem::path& path,
                 const ExportOptions& options, const std::string& format) {
  const ExportFormat& chosen = scan_export_format(path, format);
  if (options.level || options.y_up || options.origin != Vec3::Zero())
    throw Error(Cause::usage, fmt::format("{}: a scan is written as it lies; leave --level, --up "
                                          "and --origin out",
                                          path.string()));
  chosen.write_scan(path, scan, options);
}

std::vector<LeftOut> write_formats(const std::filesystem::path& folder, const World& world,
                                   const ExportOptions& options) {
  const World prepared = prepare_export(world, options);
  std::vector<LeftOut> left_out;
  for (const ExportFormat& format : export_formats()) try {
      check_fits(format, folder, options);
      format.write(folder / ("world." + format.extension), prepared, options);
    } catch (const Error& error) {
      if (error.cause != Cause::usage) throw;
      left_out.push_back({format.name, error.what()});
    }
  write_text(folder / kFormatsMark, readme(left_out));
  return left_out;
}

std::vector<LeftOut> export_all(const World& world, const std::filesystem::path& folder,
                                const ExportOptions& options) {
  OutputFolder output(folder, kFormatsMark);
  std::vector<LeftOut> left_out = write_formats(output.path(), world, options);
  output.commit();
  return left_out;
}

}  // namespace scanworld
