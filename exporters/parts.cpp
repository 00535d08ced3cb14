// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "parts.h"

#include <fmt/format.h>

#include <map>

#include "world/round_solids.h"
#include "world/solids.h"
#include "world/triangulate.h"

namespace scanworld {

namespace {

std::vector<ExportPart> merged(const std::vector<ExportPart>& parts) {
  if (parts.empty()) return {};
  ExportPart all = parts[0];
  all.name = "world";
  for (auto part = parts.begin() + 1; part != parts.end(); ++part) append(all.mesh, part->mesh);
  return {all};
}

// A cylinder's sides by the sagitta; all else has the facets that it has.
Mesh facets_of(const Obstacle& o, const Frame& frame, double sagitta) {
  if (const auto* cylinder = std::get_if<Cylinder>(&o.shape); cylinder && sagitta > 0)
    return mesh_of(*cylinder, frame.up, sides_of(cylinder->radius, sagitta));
  return mesh_of(o, frame);
}

}  // namespace

Color color_of(Kind kind) {
  switch (kind) {
    case Kind::floor:
      return {168, 148, 122};
    case Kind::ceiling:
      return {222, 222, 216};
    case Kind::wall:
      return {190, 200, 208};
    case Kind::other:
      return {120, 150, 175};
  }
  return {};
}

Color color_of(const Surface& surface) { return surface.color.value_or(color_of(surface.kind)); }

std::string name_of(const Surface& surface) {
  return fmt::format("{}_{}", name_of(surface.kind), surface.id);
}

std::string name_of(const Obstacle& obstacle) { return fmt::format("obstacle_{}", obstacle.id); }

std::string safe_name(const std::filesystem::path& path) {
  std::string name = path.stem().string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '_' && c != '-') c = '_';
  return name.empty() ? "world" : name;
}

std::vector<ExportPart> export_parts(const World& world, const ExportOptions& options) {
  std::vector<ExportPart> parts;
  for (const Surface& s : world.surfaces)
    parts.push_back({name_of(s), s.id, true, s.kind, color_of(s), {}});

  const WorldMesh triangles = triangulate(world);
  std::vector<std::map<int, int>> local(
      parts.size());  // of each part: vertex of the world -> of the part
  for (std::size_t t = 0; t < triangles.surface.size(); ++t) {
    const std::size_t part = static_cast<std::size_t>(triangles.surface[t]);
    Mesh& mesh = parts[part].mesh;
    std::array<int, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const int vertex = triangles.mesh.triangles[t][k];
      const auto [found, is_new] =
          local[part].try_emplace(vertex, static_cast<int>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back(world.vertices[static_cast<std::size_t>(vertex)]);
      triangle[k] = found->second;
    }
    mesh.triangles.push_back(triangle);
  }
  for (const Obstacle& o : world.obstacles)
    parts.push_back({name_of(o), o.id, false, Kind::other, color_of(Kind::other),
                     facets_of(o, world.frame, options.sagitta)});
  return options.merge ? merged(parts) : parts;
}

}  // namespace scanworld
