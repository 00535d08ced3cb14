// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "stl.h"

#include <cstring>

#include "files.h"
#include "parts.h"

namespace scanworld {

void write_stl(const std::filesystem::path& path, const World& world,
               const ExportOptions& options) {
  const std::vector<ExportPart> parts = export_parts(world, options);
  std::uint32_t triangles = 0;
  for (const ExportPart& part : parts)
    triangles += static_cast<std::uint32_t>(part.mesh.triangles.size());

  OutputFile file(path);
  char header[80] = "binary STL by scanworld, metres";  // must not start with "solid"
  file.write(header, sizeof(header));
  file.write(&triangles, sizeof(triangles));
  for (const ExportPart& part : parts)
    for (const auto& t : part.mesh.triangles) {
      const Vec3 &a = part.mesh.vertices[static_cast<std::size_t>(t[0])],
                 &b = part.mesh.vertices[static_cast<std::size_t>(t[1])],
                 &c = part.mesh.vertices[static_cast<std::size_t>(t[2])];
      const Vec3f rows[4] = {(b - a).cross(c - a).normalized().cast<float>(), a.cast<float>(),
                             b.cast<float>(), c.cast<float>()};
      char record[50] = {};  // normal, corners, and two bytes that nobody uses
      std::memcpy(record, rows, sizeof(rows));
      file.write(record, sizeof(record));
    }
  file.commit();
}

}  // namespace scanworld
