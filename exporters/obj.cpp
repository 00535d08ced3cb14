// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "obj.h"

#include <fmt/format.h>

#include <set>

#include "files.h"
#include "parts.h"

namespace scanworld {

namespace {

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

// A mesh as an object whose first vertex has the number `base`.
std::string object_text(const std::string& name, const std::string& material, const Mesh& mesh,
                        int base) {
  std::string obj = fmt::format("o {}\n", name);
  if (!material.empty()) obj += fmt::format("usemtl {}\n", material);
  for (const Vec3& v : mesh.vertices)
    obj += fmt::format("v {:.6f} {:.6f} {:.6f}\n", v.x(), v.y(), v.z());
  for (const auto& t : mesh.triangles)
    obj += fmt::format("f {} {} {}\n", t[0] + base, t[1] + base, t[2] + base);
  return obj;
}

}  // namespace

std::string obj_text(const std::string& name, const Mesh& mesh) {
  return object_text(name, "", mesh, 1);
}

void write_obj(const std::filesystem::path& path, const World& world,
               const ExportOptions& options) {
  const std::vector<ExportPart> parts = export_parts(world, options);
  const std::filesystem::path mtl_path = path.parent_path() / (safe_name(path) + ".mtl");

  std::string mtl = "# scanworld\n";
  std::set<std::string> known;
  for (const ExportPart& part : parts)
    if (known.insert(material_name(part)).second)
      mtl += fmt::format("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\n", material_name(part),
                         part.color.r / 255.0, part.color.g / 255.0, part.color.b / 255.0);

  std::string obj = frame_comment(world.frame);
  obj += fmt::format("mtllib {}\n", mtl_path.filename().string());
  int base = 1;
  for (const ExportPart& part : parts) {
    obj += object_text(part.name, material_name(part), part.mesh, base);
    base += static_cast<int>(part.mesh.vertices.size());
  }

  OutputFile mtl_file(mtl_path), obj_file(path);
  mtl_file.write(mtl);
  obj_file.write(obj);
  mtl_file.commit();
  obj_file.commit();
}

}  // namespace scanworld
