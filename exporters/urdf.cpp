// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "urdf.h"

#include "bodies.h"
#include "files.h"
#include "mesh_folder.h"
#include "parts.h"
#include "xml.h"

namespace scanworld {

namespace {

XmlElement mesh_element(const std::string& file) {
  return {"geometry", {}, {{"mesh", {{"filename", file}}, {}, ""}}, ""};
}

XmlElement geometry_of(const ExportBody& body, const std::string& folder) {
  if (const auto* box = std::get_if<BoxShape>(&body.shape))
    return {"geometry", {}, {{"box", {{"size", text_of(box->size)}}, {}, ""}}, ""};
  if (const auto* cylinder = std::get_if<CylinderShape>(&body.shape))
    return {"geometry",
            {},
            {{"cylinder",
              {{"radius", text_of(cylinder->radius)}, {"length", text_of(cylinder->height)}},
              {},
              ""}},
            ""};
  if (is_ball(body))
    return {"geometry", {}, {{"sphere", {{"radius", text_of(body.round->radius)}}, {}, ""}}, ""};
  return mesh_element(folder + "/" + mesh_file_of(body));
}

}  // namespace

void write_urdf(const std::filesystem::path& path, const World& world,
                const ExportOptions& options) {
  const std::vector<ExportBody> bodies = export_bodies(world, options);
  const std::string name = safe_name(path), folder = name + "_meshes";

  XmlElement robot{"robot", {{"name", name}}, {}, ""};
  XmlElement& link = robot.add({"link", {{"name", name}}, {}, ""});
  // Only Bullet reads it; URDF itself has no friction.
  link.add(
      {"contact", {}, {{"lateral_friction", {{"value", text_of(options.friction)}}, {}, ""}}, ""});
  if (!world.surfaces.empty() || !world.obstacles.empty())
    link.add({"visual", {{"name", "surfaces"}}, {mesh_element(folder + "/" + kVisualMesh)}, ""});
  for (const ExportBody& body : bodies)
    link.add(
        {"collision",
         {{"name", body.name}},
         {{"origin", {{"xyz", text_of(body.position)}, {"rpy", rpy_text(body.rotation)}}, {}, ""},
          geometry_of(body, folder)},
         ""});

  OutputFile file(path);
  file.write(xml_document(robot));
  write_mesh_folder(path.parent_path() / folder, world, bodies, options);
  file.commit();
}

}  // namespace scanworld
