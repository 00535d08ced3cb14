// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "gltf.h"

#include <cstring>
#include <sstream>

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include "bodies.h"
#include "error.h"
#include "files.h"
#include "parts.h"
#include "version.h"

namespace scanworld {

namespace {

constexpr const char* kShapes = "KHR_implicit_shapes";
constexpr const char* kRigidBodies = "KHR_physics_rigid_bodies";

// From Z-up to Y-up, for vertices and for orientations.
Vec3f y_up(const Vec3& v) { return Vec3(v.x(), v.z(), -v.y()).cast<float>(); }
const Eigen::Quaterniond kYUp = y_up_turn();

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
    const int mesh = add_mesh(part.name, part.mesh, part.color);
    if (mesh < 0) return;
    tinygltf::Node node;
    node.name = part.name;
    node.mesh = mesh;
    node.extras =
        tinygltf::Value({{part.is_surface ? "surface_id" : "obstacle_id", tinygltf::Value(part.id)},
                         {"kind", tinygltf::Value(std::string(name_of(part.kind)))}});
    model_.scenes[0].nodes.push_back(add_node(node));
  }

  // The solids, as KHR_physics_rigid_bodies and KHR_implicit_shapes were in October 2025. A node
  // without motion stands still.
  void add(const std::vector<ExportBody>& bodies, double friction) {
    if (bodies.empty()) return;
    model_.extensionsUsed = {kShapes, kRigidBodies};
    tinygltf::Node root;
    root.name = "colliders";
    tinygltf::Value::Array shapes;
    for (const ExportBody& body : bodies) {
      tinygltf::Node node;
      node.name = body.name;
      const Vec3 p = kYUp * body.position;
      Eigen::Quaterniond q = kYUp * body.rotation;
      if (!std::holds_alternative<BoxShape>(body.shape))
        q = q * kYUp.conjugate();  // the axis of cylinders is y there, and meshes are Y-up
      node.translation = {p.x(), p.y(), p.z()};
      node.rotation = {q.x(), q.y(), q.z(), q.w()};
      node.extensions[kRigidBodies] =
          object("collider", tinygltf::Value({{"geometry", geometry_of(body, shapes)},
                                              {"physicsMaterial", tinygltf::Value(0)}}));
      root.children.push_back(add_node(node));
    }
    if (!shapes.empty()) model_.extensions[kShapes] = object("shapes", tinygltf::Value(shapes));
    const tinygltf::Value material({{"staticFriction", tinygltf::Value(friction)},
                                    {"dynamicFriction", tinygltf::Value(friction)},
                                    {"restitution", tinygltf::Value(0.0)}});
    model_.extensions[kRigidBodies] =
        object("physicsMaterials", tinygltf::Value(tinygltf::Value::Array{material}));
    model_.scenes[0].nodes.push_back(add_node(root));
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
  static tinygltf::Value object(const std::string& key, const tinygltf::Value& value) {
    return tinygltf::Value(tinygltf::Value::Object{{key, value}});
  }

  int add_node(const tinygltf::Node& node) {
    model_.nodes.push_back(node);
    return static_cast<int>(model_.nodes.size()) - 1;
  }

  // What a collider is: a shape, added to the others, or the hull of a node's mesh that is in no
  // scene, so that it is not seen.
  tinygltf::Value geometry_of(const ExportBody& body, tinygltf::Value::Array& shapes) {
    if (const auto* convex = std::get_if<ConvexShape>(&body.shape)) {
      tinygltf::Node node;
      node.name = body.name + "_hull";
      node.mesh = add_mesh(node.name, convex->mesh, body.color);
      return tinygltf::Value(
          {{"node", tinygltf::Value(add_node(node))}, {"convexHull", tinygltf::Value(true)}});
    }
    if (const auto* box = std::get_if<BoxShape>(&body.shape)) {
      shapes.push_back(tinygltf::Value({{"type", tinygltf::Value(std::string("box"))},
                                        {"box", object("size", list_of(box->size))}}));
    } else {
      const CylinderShape& c = std::get<CylinderShape>(body.shape);
      shapes.push_back(tinygltf::Value(
          {{"type", tinygltf::Value(std::string("cylinder"))},
           {"cylinder", tinygltf::Value({{"height", tinygltf::Value(c.height)},
                                         {"radiusBottom", tinygltf::Value(c.radius)},
                                         {"radiusTop", tinygltf::Value(c.radius)}})}}));
    }
    return object("shape", tinygltf::Value(static_cast<int>(shapes.size()) - 1));
  }

  // Adds a mesh with flat faces, its vertices turned to Y-up; gives -1 where nothing is left of it
  // in single precision.
  int add_mesh(const std::string& name, const Mesh& faces, const Color& color) {
    // A flat face has one normal, so faces do not share vertices with others of another normal.
    std::vector<Vec3f> points, normals;
    std::vector<std::uint32_t> corners;
    std::map<std::array<float, 6>, std::uint32_t> index_of;
    for (const auto& t : faces.triangles) {
      std::array<Vec3f, 3> p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = y_up(faces.vertices[static_cast<std::size_t>(t[k])]);
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
    if (corners.empty()) return -1;

    tinygltf::Primitive primitive;
    primitive.attributes["POSITION"] = add_vectors(points, true);
    primitive.attributes["NORMAL"] = add_vectors(normals, false);
    primitive.indices = add_accessor(corners.data(), corners.size(), sizeof(std::uint32_t),
                                     TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                                     TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = material(color);
    tinygltf::Mesh mesh;
    mesh.name = name;
    mesh.primitives.push_back(primitive);
    model_.meshes.push_back(mesh);
    return static_cast<int>(model_.meshes.size()) - 1;
  }

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

void write_glb(const std::filesystem::path& path, const World& world,
               const ExportOptions& options) {
  Builder builder(world);
  for (const ExportPart& part : export_parts(world, options)) builder.add(part);
  if (options.physics) builder.add(export_bodies(world, options), options.friction);
  write_text(path, builder.write());
}

}  // namespace scanworld
