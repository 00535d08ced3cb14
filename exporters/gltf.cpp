// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "gltf.h"

#include <cstring>
#include <sstream>

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include "error.h"
#include "files.h"
#include "parts.h"
#include "version.h"

namespace scanworld {

namespace {

Vec3f y_up(const Vec3& v) { return Vec3(v.x(), v.z(), -v.y()).cast<float>(); }

tinygltf::Value list_of(const Vec3& v) {
  return tinygltf::Value({tinygltf::Value(v.x()), tinygltf::Value(v.y()), tinygltf::Value(v.z())});
}

class Builder {
 public:
  explicit Builder(const World& world) {
    model_.asset.version = "2.0";
    model_.asset.generator = std::string("scanworld ") + version();
    const Eigen::Quaterniond& q = world.frame.rotation;
    model_.asset.extras = tinygltf::Value(
        {{"scan_origin", list_of(world.frame.origin)},
         {"scan_rotation", tinygltf::Value({tinygltf::Value(q.x()), tinygltf::Value(q.y()),
                                            tinygltf::Value(q.z()), tinygltf::Value(q.w())})},
         {"scan_up", list_of(world.frame.up)}});
    model_.buffers.emplace_back();
    model_.scenes.emplace_back();
    model_.scenes[0].name = "world";
    model_.defaultScene = 0;
  }

  void add(const ExportPart& part) {
    // A flat face has one normal, so faces do not share vertices with others of another normal.
    std::vector<Vec3f> points, normals;
    std::vector<std::uint32_t> corners;
    std::map<std::array<float, 6>, std::uint32_t> index_of;
    for (const auto& t : part.mesh.triangles) {
      std::array<Vec3f, 3> p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = y_up(part.mesh.vertices[static_cast<std::size_t>(t[k])]);
      const Vec3f n = (p[1] - p[0])
                          .cast<double>()
                          .cross((p[2] - p[0]).cast<double>())
                          .normalized()
                          .cast<float>();
      if (!n.allFinite() || n.isZero()) continue;  // no area in single precision
      for (const Vec3f& q : p) {
        const auto [found, is_new] =
            index_of.try_emplace({q.x(), q.y(), q.z(), n.x(), n.y(), n.z()}, points.size());
        if (is_new) points.push_back(q), normals.push_back(n);
        corners.push_back(found->second);
      }
    }
    if (corners.empty()) return;

    tinygltf::Primitive primitive;
    primitive.attributes["POSITION"] = add_vectors(points, true);
    primitive.attributes["NORMAL"] = add_vectors(normals, false);
    primitive.indices = add_accessor(corners.data(), corners.size(), sizeof(std::uint32_t),
                                     TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                                     TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = material(part.color);
    tinygltf::Mesh mesh;
    mesh.name = part.name;
    mesh.primitives.push_back(primitive);
    model_.meshes.push_back(mesh);

    tinygltf::Node node;
    node.name = part.name;
    node.mesh = static_cast<int>(model_.meshes.size()) - 1;
    node.extras =
        tinygltf::Value({{part.is_surface ? "surface_id" : "obstacle_id", tinygltf::Value(part.id)},
                         {"kind", tinygltf::Value(std::string(name_of(part.kind)))}});
    model_.nodes.push_back(node);
    model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()) - 1);
  }

  std::string write() {
    if (model_.buffers[0].data.empty()) model_.buffers.clear();
    std::ostringstream out;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model_, out, false, true))
      throw Error(Cause::failure, "glTF cannot be written");
    return out.str();
  }

 private:
  int add_accessor(const void* values, std::size_t count, std::size_t size, int target,
                   int component, int type) {
    std::vector<unsigned char>& bytes = model_.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes.size();  // all parts are of 4 bytes, so it stays aligned
    view.byteLength = count * size;
    view.target = target;
    bytes.resize(bytes.size() + view.byteLength);
    std::memcpy(bytes.data() + view.byteOffset, values, view.byteLength);
    model_.bufferViews.push_back(view);
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = count;
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  int add_vectors(const std::vector<Vec3f>& values, bool with_bounds) {
    const int index =
        add_accessor(values.data(), values.size(), sizeof(Vec3f), TINYGLTF_TARGET_ARRAY_BUFFER,
                     TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
    if (!with_bounds) return index;
    Vec3f low = values[0], high = values[0];
    for (const Vec3f& v : values) low = low.cwiseMin(v), high = high.cwiseMax(v);
    tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
    for (int k = 0; k < 3; ++k)
      accessor.minValues.push_back(low[k]), accessor.maxValues.push_back(high[k]);
    return index;
  }

  int material(const Color& color) {
    const auto [found, is_new] = material_of_.try_emplace(
        {color.r, color.g, color.b}, static_cast<int>(model_.materials.size()));
    if (is_new) {
      // The format's colours are linear.
      const auto linear = [](std::uint8_t v) { return std::pow(v / 255.0, 2.2); };
      tinygltf::Material material;
      material.pbrMetallicRoughness.baseColorFactor = {linear(color.r), linear(color.g),
                                                       linear(color.b), 1};
      material.pbrMetallicRoughness.metallicFactor = 0;
      material.pbrMetallicRoughness.roughnessFactor = 0.9;
      material.doubleSided = true;  // a wall is to be seen from behind too
      model_.materials.push_back(material);
    }
    return found->second;
  }

  tinygltf::Model model_;
  std::map<std::array<std::uint8_t, 3>, int> material_of_;
};

}  // namespace

void write_glb(const std::filesystem::path& path, const World& world) {
  Builder builder(world);
  for (const ExportPart& part : export_parts(world)) builder.add(part);
  OutputFile file(path);
  file.write(builder.write());
  file.commit();
}

}  // namespace scanworld
