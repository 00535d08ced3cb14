// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh_folder.h"

#include "files.h"
#include "obj.h"
#include "output_folder.h"

namespace scanworld {

std::string mesh_file_of(const ExportBody& body) { return body.name + ".obj"; }

void write_mesh_folder(const std::filesystem::path& folder, const World& world,
                       const std::vector<ExportBody>& bodies, const ExportOptions& options) {
  OutputFolder output(folder, kVisualMesh);
  write_obj(output.path() / kVisualMesh, world, options);
  for (const ExportBody& body : bodies)
    if (const auto* convex = std::get_if<ConvexShape>(&body.shape); convex && !is_ball(body))
      write_text(output.path() / mesh_file_of(body), obj_text(body.name, convex->mesh));
  output.commit();
}

}  // namespace scanworld
