// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// A URDF file as urdfdom reads it, its meshes as assimp does; rays meet the collisions, in Bullet.
#include <assimp/scene.h>
#include <urdf_parser/urdf_parser.h>

#include <assimp/Importer.hpp>
#include <filesystem>

#include "bullet_rays.h"

namespace {

class Urdf : public Consumer {
 public:
  explicit Urdf(const std::string& file) : folder_(std::filesystem::path(file).parent_path()) {
    const auto model = urdf::parseURDFFile(file);
    if (!model) throw std::runtime_error("urdfdom cannot read " + file);
    const auto link = model->getRoot();
    if (!link->child_links.empty() || link->inertial) throw std::runtime_error("it can move");
    for (const auto& c : link->collision_array) add(*c);
    for (const auto& v : link->visual_array)
      seen_.add_triangles(btTransform::getIdentity(),
                          triangles_of(static_cast<const urdf::Mesh&>(*v->geometry).filename));
  }
  std::vector<std::string> names() override { return names_; }
  double ray(const Triple& from, const Triple& direction, Meets what) override {
    return (what == Meets::seen ? seen_ : solids_).cast(from, direction);
  }

 private:
  std::vector<btVector3> triangles_of(const std::string& name) const {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile((folder_ / name).string(), 0);
    if (!scene || scene->mNumMeshes == 0) throw std::runtime_error("no mesh at " + name);
    std::vector<btVector3> corners;
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
      const aiMesh& mesh = *scene->mMeshes[m];
      for (unsigned f = 0; f < mesh.mNumFaces; ++f)
        for (unsigned k = 0; k < 3; ++k) {
          const aiVector3D& v = mesh.mVertices[mesh.mFaces[f].mIndices[k]];
          corners.emplace_back(v.x, v.y, v.z);
        }
    }
    return corners;
  }

  void add(const urdf::Collision& c) {
    names_.push_back(c.name);
    const auto& p = c.origin.position;
    const auto& q = c.origin.rotation;
    const btTransform at(btQuaternion(q.x, q.y, q.z, q.w), btVector3(p.x, p.y, p.z));
    if (c.geometry->type == urdf::Geometry::BOX) {
      const auto& size = static_cast<const urdf::Box&>(*c.geometry).dim;
      solids_.add_box(at, {size.x, size.y, size.z});
    } else if (c.geometry->type == urdf::Geometry::CYLINDER) {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(*c.geometry);
      solids_.add_cylinder(at, cylinder.radius, cylinder.length);
    } else {
      solids_.add_triangles(at, triangles_of(static_cast<const urdf::Mesh&>(*c.geometry).filename));
    }
  }

  std::filesystem::path folder_;
  std::vector<std::string> names_;
  BulletRays seen_, solids_;
};

}  // namespace

int main(int argc, char** argv) {
  return serve(argc, argv, [](const std::string& file) { return std::make_unique<Urdf>(file); });
}
