// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "ply.h"

#include <fmt/format.h>

#include <cstring>
#include <map>

#include "files.h"
#include "parts.h"

namespace scanworld {

void write_ply_mesh(const std::filesystem::path& path, const World& world,
                    const ExportOptions& options) {
  const std::vector<ExportPart> parts = export_parts(world, options);
  std::vector<double> vertices;
  std::string faces;
  std::size_t face_count = 0;
  std::map<std::array<double, 3>, std::int32_t> index_of;
  const auto put = [&](const auto& value) {
    faces.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  for (const ExportPart& part : parts)
    for (const auto& t : part.mesh.triangles) {
      put(std::uint8_t{3});
      for (int corner : t) {
        const Vec3& v = part.mesh.vertices[static_cast<std::size_t>(corner)];
        const auto [found, is_new] = index_of.try_emplace(
            {v.x(), v.y(), v.z()}, static_cast<std::int32_t>(vertices.size() / 3));
        if (is_new) vertices.insert(vertices.end(), {v.x(), v.y(), v.z()});
        put(found->second);
      }
      for (std::uint8_t channel : {part.color.r, part.color.g, part.color.b}) put(channel);
      put(static_cast<std::int32_t>(part.is_surface ? part.id : -1));
      ++face_count;
    }

  OutputFile file(path);
  file.write(fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment scanworld, metres\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\nelement face {}\n"
      "property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nproperty int surface_id\nend_header\n",
      vertices.size() / 3, face_count));
  file.write_values(vertices);
  file.write(faces);
  file.commit();
}

void write_ply_mesh(const std::filesystem::path& path, const Mesh& mesh) {
  OutputFile file(path);
  file.write(fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment scanworld, metres\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size()));
  file.write_values(mesh.vertices);
  std::string faces;
  for (const auto& t : mesh.triangles) {
    faces += '\3';
    faces.append(reinterpret_cast<const char*>(t.data()), sizeof(t));
  }
  file.write(faces);
  file.commit();
}

}  // namespace scanworld
