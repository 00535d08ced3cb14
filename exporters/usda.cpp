// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "usda.h"

#include <fmt/format.h>

#include "bodies.h"
#include "files.h"
#include "parts.h"
#include "version.h"

namespace scanworld {

namespace {

std::string tuple(const Vec3& v) {
  return fmt::format("({}, {}, {})", text_of(v.x()), text_of(v.y()), text_of(v.z()));
}

// The name of a prim: letters, digits and '_', not beginning with a digit.
std::string identifier(std::string name) {
  for (char& c : name)
    if (c == '.' || c == '-') c = '_';
  return std::isdigit(static_cast<unsigned char>(name[0])) ? "_" + name : name;
}

template <typename Range, typename Text>
std::string list(const Range& range, const Text& text) {
  std::string all;
  for (const auto& item : range) all += (all.empty() ? "" : ", ") + text(item);
  return "[" + all + "]";
}

// Writes prims, each line indented by how deep it is.
class Writer {
 public:
  std::string text;

  void line(const std::string& s) { text += std::string(4 * depth_, ' ') + s + "\n"; }
  void open(const std::string& type, const std::string& name, const std::string& metadata = "") {
    line(fmt::format("def {} \"{}\"{}", type, name, metadata.empty() ? "" : " ("));
    if (!metadata.empty()) line("    " + metadata), line(")");
    line("{");
    ++depth_;
  }
  void close() {
    --depth_;
    line("}");
  }

  void mesh(const Mesh& mesh) {
    Box3 box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    line(fmt::format("float3[] extent = [{}, {}]", tuple(box.min()), tuple(box.max())));
    line("int[] faceVertexCounts = " +
         list(mesh.triangles, [](const auto&) { return std::string("3"); }));
    line("int[] faceVertexIndices = " + list(mesh.triangles, [](const auto& t) {
           return fmt::format("{}, {}, {}", t[0], t[1], t[2]);
         }));
    line("point3f[] points = " + list(mesh.vertices, tuple));
    line("uniform token subdivisionScheme = \"none\"");
  }

  void place(const ExportBody& body, const Vec3& scale) {
    const Eigen::Quaterniond& q = body.rotation;
    line("double3 xformOp:translate = " + tuple(body.position));
    line(fmt::format("quatd xformOp:orient = ({}, {}, {}, {})", text_of(q.w()), text_of(q.x()),
                     text_of(q.y()), text_of(q.z())));
    const bool is_scaled = !scale.isOnes();
    if (is_scaled) line("float3 xformOp:scale = " + tuple(scale));
    line(fmt::format("uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\"{}]",
                     is_scaled ? ", \"xformOp:scale\"" : ""));
  }

 private:
  std::size_t depth_ = 0;
};

constexpr const char* kCollision = "prepend apiSchemas = [\"PhysicsCollisionAPI\"]";

void write_surface(Writer& out, const ExportPart& part) {
  out.open("Mesh", part.name);
  out.mesh(part.mesh);
  out.line("bool doubleSided = 1");
  out.line(fmt::format("color3f[] primvars:displayColor = [({:.4g}, {:.4g}, {:.4g})]",
                       part.color.r / 255.0, part.color.g / 255.0, part.color.b / 255.0));
  out.close();
}

void write_body(Writer& out, const ExportBody& body) {
  if (const auto* box = std::get_if<BoxShape>(&body.shape)) {
    out.open("Cube", body.name, kCollision);
    out.line("float3[] extent = [(-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)]");
    out.line("double size = 1");
    out.place(body, box->size);
  } else if (const auto* cylinder = std::get_if<CylinderShape>(&body.shape)) {
    const Vec3 half(cylinder->radius, cylinder->radius, cylinder->height / 2);
    out.open("Cylinder", body.name, kCollision);
    out.line("uniform token axis = \"Z\"");
    out.line(fmt::format("float3[] extent = [{}, {}]", tuple(-half), tuple(half)));
    out.line("double height = " + text_of(cylinder->height));
    out.line("double radius = " + text_of(cylinder->radius));
    out.place(body, Vec3::Ones());
  } else if (body.round) {
    const auto& [type, radius, height] = *body.round;
    const Vec3 half(radius, radius, height / 2);
    out.open(type == CurveType::sphere ? "Sphere" : "Cone", body.name, kCollision);
    out.line(fmt::format("float3[] extent = [{}, {}]", tuple(-half), tuple(half)));
    out.line("double radius = " + text_of(radius));
    if (type == CurveType::cone) {
      out.line("uniform token axis = \"Z\"");
      out.line("double height = " + text_of(height));
    }
    out.place(body, Vec3::Ones());
  } else {
    out.open("Mesh", body.name,
             "prepend apiSchemas = [\"PhysicsCollisionAPI\", \"PhysicsMeshCollisionAPI\"]");
    out.mesh(std::get<ConvexShape>(body.shape).mesh);
    out.line("uniform token physics:approximation = \"convexHull\"");
    out.place(body, Vec3::Ones());
  }
  out.close();
}

void write_scene(Writer& out, const World& world) {
  const Vec3 gravity = gravity_of(world);
  out.open("PhysicsScene", "physics_scene");
  out.line("vector3f physics:gravityDirection = " + tuple(gravity.normalized()));
  out.line("float physics:gravityMagnitude = " + text_of(gravity.norm()));
  out.close();
}

void write_material(Writer& out, double friction) {
  out.open("Material", "physics_material", "prepend apiSchemas = [\"PhysicsMaterialAPI\"]");
  out.line("float physics:dynamicFriction = " + text_of(friction));
  out.line("float physics:staticFriction = " + text_of(friction));
  out.close();
}

}  // namespace

void write_usda(const std::filesystem::path& path, const World& world,
                const ExportOptions& options) {
  const std::string root = identifier(safe_name(path));
  Writer out;
  out.text = fmt::format(
      "#usda 1.0\n(\n    defaultPrim = \"{}\"\n    doc = \"Made by scanworld {}\"\n"
      "    metersPerUnit = 1\n    upAxis = \"{}\"\n)\n\n",
      root, version(), options.y_up ? "Y" : "Z");
  out.open("Xform", root);
  out.open("Scope", "visual");
  for (const ExportPart& part : export_parts(world, options)) write_surface(out, part);
  out.close();
  out.open("Scope", "collision", "prepend apiSchemas = [\"MaterialBindingAPI\"]");
  out.line(fmt::format("rel material:binding:physics = </{}/physics_material>", root));
  out.line("uniform token purpose = \"guide\"");
  for (const ExportBody& body : export_bodies(world, options)) write_body(out, body);
  out.close();
  write_material(out, options.friction);
  out.close();
  write_scene(out, world);
  write_text(path, out.text);
}

}  // namespace scanworld
