// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "obj.h"

#include <fmt/format.h>

#include <set>

#include "bodies.h"
#include "files.h"
#include "parts.h"

namespace scanworld {

namespace {

constexpr const char* kMtlTitle = "# scanworld\n";

// Surfaces without a colour of their own share one material a kind.
std::string material_name(const ExportPart& part) {
  if (part.color == color_of(part.kind)) return part.is_surface ? name_of(part.kind) : "obstacle";
  return fmt::format("rgb_{:02x}{:02x}{:02x}", part.color.r, part.color.g, part.color.b);
}

std::string frame_comment(const Frame& frame) {
  std::string text = "# scanworld: metres";
  text += fmt::format(", up is {} {} {}", frame.up.x(), frame.up.y(), frame.up.z());
  std::vector<std::string> steps;
  if (const Eigen::Vector4d q = frame.rotation.coeffs(); q != Eigen::Vector4d::UnitW())
    steps.push_back(
        fmt::format("turn by the quaternion (x y z w) {} {} {} {}", q[0], q[1], q[2], q[3]));
  if (const Vec3& o = frame.origin; !o.isZero())
    steps.push_back(fmt::format("add {} {} {}", o.x(), o.y(), o.z()));
  if (!steps.empty())
    text += fmt::format(", {} to get the scan's coordinates", fmt::join(steps, " and "));
  return text + "\n";
}

// How many vertices and normals were written so far.
struct Count {
  int vertices = 0, normals = 0;
};

// A mesh as an object. Faces have normals, as DART leaves out what has none.
std::string object_text(const std::string& name, const std::string& material, const Mesh& mesh,
                        Count& count) {
  std::string obj = fmt::format("o {}\n", name), normals, faces;
  if (!material.empty()) obj += fmt::format("usemtl {}\n", material);
  for (const Vec3& v : mesh.vertices)
    obj += fmt::format("v {:.6f} {:.6f} {:.6f}\n", v.x(), v.y(), v.z());
  std::string last;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    const Vec3 n = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    const std::string normal =
        "vn " + text_of(n.unaryExpr([](double x) { return std::round(x * 1e6) / 1e6; })) + "\n";
    if (normal != last) normals += last = normal, ++count.normals;
    const auto corner = [&](int v) {
      return fmt::format(" {}//{}", v + 1 + count.vertices, count.normals);
    };
    faces += "f" + corner(t[0]) + corner(t[1]) + corner(t[2]) + "\n";
  }
  count.vertices += static_cast<int>(mesh.vertices.size());
  return obj + normals + faces;
}

}  // namespace

std::string obj_text(const std::string& name, const Mesh& mesh) {
  Count none;
  return object_text(name, "", mesh, none);
}

void write_obj(const std::filesystem::path& path, const World& world,
               const ExportOptions& options) {
  const std::vector<ExportPart> parts = export_parts(world, options);
  const std::filesystem::path mtl_path = path.parent_path() / (safe_name(path) + ".mtl");

  std::string mtl = kMtlTitle;
  std::set<std::string> known;
  for (const ExportPart& part : parts)
    if (known.insert(material_name(part)).second)
      mtl += fmt::format("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\n", material_name(part),
                         part.color.r / 255.0, part.color.g / 255.0, part.color.b / 255.0);

  std::string obj = frame_comment(world.frame);
  obj += fmt::format("mtllib {}\n", mtl_path.filename().string());
  Count count;
  for (const ExportPart& part : parts)
    obj += object_text(part.name, material_name(part), part.mesh, count);

  check_replaces_own(mtl_path, kMtlTitle);
  OutputFile mtl_file(mtl_path), obj_file(path);
  mtl_file.write(mtl);
  obj_file.write(obj);
  mtl_file.commit();
  obj_file.commit();
}

}  // namespace scanworld
