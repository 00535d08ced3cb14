// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "export.h"

#include <fmt/format.h>

#include <algorithm>

#include "assimp.h"
#include "error.h"
#include "files.h"
#include "gltf.h"
#include "obj.h"
#include "ply.h"
#include "stl.h"
#include "world/world_json.h"

namespace scanworld {

const std::vector<ExportFormat>& export_formats() {
  static const std::vector<ExportFormat> formats = {
      {"obj", "Wavefront OBJ with MTL, an object a surface", write_obj},
      {"stl", "binary STL, triangles only", write_stl},
      {"glb", "binary glTF 2.0, Y-up, a named node a surface", write_glb},
      {"ply", "binary PLY mesh, shared vertices, face colours and surface ids", write_ply_mesh},
      {"dae", "Collada, by assimp",
       [](const std::filesystem::path& path, const World& world) {
         write_with_assimp(path, world, "collada");
       }},
      {"json", "the world itself, world.json", write_world},
  };
  return formats;
}

const ExportFormat& export_format(const std::filesystem::path& path, const std::string& name) {
  const std::string wanted = !name.empty()                   ? name
                             : lower_extension(path).empty() ? ""
                                                             : lower_extension(path).substr(1);
  const auto& formats = export_formats();
  const auto found = std::find_if(formats.begin(), formats.end(),
                                  [&](const ExportFormat& f) { return f.name == wanted; });
  if (found != formats.end()) return *found;
  std::string names;
  for (const ExportFormat& f : formats) names += (names.empty() ? "" : ", ") + f.name;
  throw Error(Cause::usage, fmt::format("{}: '{}' is no export format; there are {}", path.string(),
                                        wanted, names));
}

void export_world(const World& world, const std::filesystem::path& path,
                  const std::string& format) {
  export_format(path, format).write(path, world);
}

}  // namespace scanworld
