// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "mjcf.h"

#include <fmt/format.h>

#include <map>

#include "bodies.h"
#include "files.h"
#include "parts.h"
#include "xml.h"

namespace scanworld {

namespace {

constexpr double kSheet = 0.001;  // [m]

// The mesh of a flat polygon as a closed one, so much thicker behind.
Mesh sheet_of(const Mesh& flat, const Vec3& normal) {
  Mesh sheet = flat;
  const int n = static_cast<int>(flat.vertices.size());
  std::map<std::pair<int, int>, int> directed;  // edges, to find those at the border
  for (const Vec3& v : flat.vertices) sheet.vertices.push_back(v - kSheet * normal);
  for (const auto& [a, b, c] : flat.triangles) {
    sheet.triangles.push_back({c + n, b + n, a + n});
    ++directed[{a, b}], ++directed[{b, c}], ++directed[{c, a}];
  }
  for (const auto& [edge, count] : directed) {
    const auto [a, b] = edge;
    if (directed.count({b, a})) continue;
    sheet.triangles.push_back({b, a, a + n});
    sheet.triangles.push_back({b, a + n, b + n});
  }
  return sheet;
}

std::string rgba(const Color& c) {
  return fmt::format("{:.4g} {:.4g} {:.4g} 1", c.r / 255.0, c.g / 255.0, c.b / 255.0);
}

XmlElement mesh_asset(const std::string& name, const Mesh& mesh, bool with_faces) {
  std::string vertices, faces;
  for (const Vec3& v : mesh.vertices) vertices += (vertices.empty() ? "" : "  ") + text_of(v);
  for (const auto& [a, b, c] : mesh.triangles)
    faces += fmt::format("{}{} {} {}", faces.empty() ? "" : "  ", a, b, c);
  XmlElement asset{"mesh", {{"name", name}, {"vertex", vertices}}, {}, ""};
  if (with_faces) asset.attributes.emplace_back("face", faces);
  return asset;
}

// The geom of a body; its mesh, where it needs one, goes to the assets.
XmlElement geom_of(const ExportBody& body, XmlElement& assets) {
  XmlElement geom{"geom",
                  {{"name", body.name},
                   {"class", body.is_obstacle ? "obstacle" : "collision"},
                   {"pos", text_of(body.position)},
                   {"quat", wxyz_text(body.rotation)},
                   {"rgba", rgba(body.color)}},
                  {},
                  ""};
  const auto set = [&](const std::string& type, const std::string& key, const std::string& value) {
    geom.attributes.emplace_back("type", type);
    geom.attributes.emplace_back(key, value);
  };
  if (const auto* box = std::get_if<BoxShape>(&body.shape)) {
    set("box", "size", text_of(Vec3(box->size / 2)));
  } else if (const auto* cylinder = std::get_if<CylinderShape>(&body.shape)) {
    set("cylinder", "size", text_of(cylinder->radius) + " " + text_of(cylinder->height / 2));
  } else if (is_ball(body)) {
    set("sphere", "size", text_of(body.round->radius));
  } else {
    set("mesh", "mesh", body.name);
    assets.add(mesh_asset(body.name, std::get<ConvexShape>(body.shape).mesh, false));
  }
  return geom;
}

XmlElement default_class(const std::string& name,
                         std::vector<std::pair<std::string, std::string>> attributes) {
  return {"default", {{"class", name}}, {{"geom", std::move(attributes), {}, ""}}, ""};
}

XmlElement defaults(const ExportOptions& options) {
  const std::string friction = text_of(options.friction) + " 0.005 0.0001";
  return {"default",
          {},
          {default_class("collision", {{"group", "3"}, {"friction", friction}}),
           default_class("obstacle", {{"group", "0"}, {"friction", friction}}),
           default_class("visual", {{"group", "2"}, {"contype", "0"}, {"conaffinity", "0"}})},
          ""};
}

// What a camera needs to know to see all of it.
XmlElement statistic(const Box3& box) {
  return {"statistic",
          {{"center", text_of(Vec3(box.center()))}, {"extent", text_of(box.diagonal().norm())}},
          {},
          ""};
}

}  // namespace

void write_mjcf(const std::filesystem::path& path, const World& world,
                const ExportOptions& options) {
  XmlElement assets{"asset", {}, {}, ""}, body{"worldbody", {}, {}, ""};
  const Vec3 up = world.frame.up;
  body.add(
      {"light", {{"directional", "true"}, {"dir", text_of(Vec3(Vec3(0.3, 0.2, 0) - up))}}, {}, ""});
  for (const ExportBody& solid : export_bodies(world, options)) body.add(geom_of(solid, assets));
  const std::vector<ExportPart> parts = export_parts(world);
  for (std::size_t i = 0; i < world.surfaces.size(); ++i) {
    const ExportPart& part = parts[i];
    assets.add(mesh_asset(part.name, sheet_of(part.mesh, world.surfaces[i].plane.normal), true));
    body.add({"geom",
              {{"name", part.name},
               {"class", "visual"},
               {"type", "mesh"},
               {"mesh", part.name},
               {"rgba", rgba(part.color)}},
              {},
              ""});
  }
  XmlElement mujoco{"mujoco", {{"model", path.stem().string()}}, {}, ""};
  mujoco.add({"option", {{"gravity", text_of(gravity_of(world))}}, {}, ""});
  if (const Box3 box = bounds(world); !box.isEmpty()) mujoco.add(statistic(box));
  mujoco.add(defaults(options));
  mujoco.add(std::move(assets));
  mujoco.add(std::move(body));
  write_text(path, xml_document(mujoco));
}

}  // namespace scanworld
