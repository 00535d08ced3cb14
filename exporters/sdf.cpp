// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sdf.h"

#include "bodies.h"
#include "files.h"
#include "mesh_folder.h"
#include "output_folder.h"
#include "parts.h"
#include "version.h"
#include "xml.h"

namespace scanworld {

namespace {

XmlElement mesh_element(const std::string& model, const std::string& file) {
  return {"mesh", {}, {text_element("uri", "model://" + model + "/meshes/" + file)}, ""};
}

XmlElement shape_of(const ExportBody& body, const std::string& model) {
  if (const auto* box = std::get_if<BoxShape>(&body.shape))
    return {"box", {}, {text_element("size", text_of(box->size))}, ""};
  if (const auto* cylinder = std::get_if<CylinderShape>(&body.shape))
    return {"cylinder",
            {},
            {text_element("radius", text_of(cylinder->radius)),
             text_element("length", text_of(cylinder->height))},
            ""};
  if (is_ball(body))
    return {"sphere", {}, {text_element("radius", text_of(body.round->radius))}, ""};
  return mesh_element(model, mesh_file_of(body));
}

XmlElement friction_element(double friction) {
  const std::string mu = text_of(friction);
  return {
      "surface",
      {},
      {{"friction", {}, {{"ode", {}, {text_element("mu", mu), text_element("mu2", mu)}, ""}}, ""}},
      ""};
}

XmlElement model_config(const std::string& model) {
  return {"model",
          {},
          {text_element("name", model),
           text_element("version", "1.0"),
           {"sdf", {{"version", "1.7"}}, {}, "model.sdf"},
           text_element("description", std::string("Made by scanworld ") + version())},
          ""};
}

XmlElement model_sdf(const std::string& model, const World& world,
                     const std::vector<ExportBody>& bodies, const ExportOptions& options) {
  XmlElement link{"link", {{"name", "link"}}, {}, ""};
  if (!world.surfaces.empty() || !world.obstacles.empty())
    link.add({"visual",
              {{"name", "surfaces"}},
              {{"geometry", {}, {mesh_element(model, kVisualMesh)}, ""}},
              ""});
  for (const ExportBody& body : bodies)
    link.add({"collision",
              {{"name", body.name}},
              {text_element("pose", text_of(body.position) + " " + rpy_text(body.rotation)),
               {"geometry", {}, {shape_of(body, model)}, ""},
               friction_element(options.friction)},
              ""});
  return {"sdf",
          {{"version", "1.7"}},
          {{"model", {{"name", model}}, {text_element("static", "true"), link}, ""}},
          ""};
}

// The model's light and gravity; all else is left to the defaults of the simulator.
XmlElement world_sdf(const std::string& name, const std::string& model, const World& world) {
  const XmlElement sun{
      "light",
      {{"name", "sun"}, {"type", "directional"}},
      {text_element("direction", text_of(Vec3(-world.frame.up + Vec3(0.3, 0.2, 0)))),
       text_element("diffuse", "0.8 0.8 0.8 1"), text_element("specular", "0.2 0.2 0.2 1")},
      ""};
  return {"sdf",
          {{"version", "1.7"}},
          {{"world",
            {{"name", name + "_world"}},  // the name "world" is reserved
            {text_element("gravity", text_of(gravity_of(world))),
             sun,
             {"include", {}, {text_element("uri", "model://" + model)}, ""}},
            ""}},
          ""};
}

}  // namespace

void write_sdf(const std::filesystem::path& path, const World& world,
               const ExportOptions& options) {
  const std::vector<ExportBody> bodies = export_bodies(world, options);
  const std::string name = safe_name(path), model = name + "_model";
  OutputFile file(path);
  file.write(xml_document(world_sdf(name, model, world)));
  OutputFolder folder(path.parent_path() / model, "model.config");
  write_text(folder.path() / "model.config", xml_document(model_config(model)));
  write_text(folder.path() / "model.sdf", xml_document(model_sdf(model, world, bodies, options)));
  write_mesh_folder(folder.path() / "meshes", world, bodies, options);
  folder.commit();
  file.commit();
}

}  // namespace scanworld
