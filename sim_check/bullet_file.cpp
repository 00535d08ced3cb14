// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "bullet_file.h"

#include <BulletWorldImporter/btBulletWorldImporter.h>
#include <btBulletDynamicsCommon.h>

#include <cstring>
#include <fstream>

#include "child.h"
#include "error.h"
#include "timing.h"
#include "world/solids.h"

namespace scanworld::sim {

namespace {

Vec3 vec_of(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

Eigen::Quaterniond turn_of(const btTransform& t) {
  const btQuaternion q = t.getRotation();
  return Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized();
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw Error(Cause::bad_input, path.string() + ": " + why);
}

// Gathers the triangles of a mesh shape.
struct Gather : btInternalTriangleIndexCallback {
  Gather(Mesh& to, const btTransform& at) : mesh(to), place(at) {}
  void internalProcessTriangleIndex(btVector3* corners, int, int) override {
    const int base = static_cast<int>(mesh.vertices.size());
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(vec_of(place * corners[k]));
    mesh.triangles.push_back({base, base + 1, base + 2});
  }
  Mesh& mesh;
  btTransform place;
};

void append_triangles(Mesh& mesh, const btBvhTriangleMeshShape& shape, const btTransform& at) {
  Gather gather(mesh, at);
  const btScalar far = btScalar(1e18);
  shape.getMeshInterface()->InternalProcessAllTriangles(&gather, {-far, -far, -far},
                                                        {far, far, far});
}

// The axis of a cylinder shape turned to z.
btTransform along_z(int axis) {
  const btQuaternion turns[] = {{btVector3(0, 1, 0), SIMD_HALF_PI},
                                {btVector3(1, 0, 0), -SIMD_HALF_PI},
                                btQuaternion::getIdentity()};
  return btTransform(turns[axis]);
}

ConvexShape hull_of(const btConvexHullShape& shape) {
  ConvexHull hull;
  for (int i = 0; i < shape.getNumPoints(); ++i)
    hull.vertices.push_back(vec_of(shape.getScaledPoint(i)));
  return {mesh_of(hull)};
}

class Reader {
 public:
  Reader(const std::filesystem::path& path, BulletFile& file) : path_(path), file_(file) {}

  void add(const std::string& name, const btCollisionShape& shape, const btTransform& at) {
    const auto solid = [&](const btTransform& pose, auto body) {
      file_.solids.push_back({.name = name,
                              .position = vec_of(pose.getOrigin()),
                              .rotation = turn_of(pose),
                              .shape = std::move(body)});
    };
    switch (shape.getShapeType()) {
      case BOX_SHAPE_PROXYTYPE:
        return solid(
            at,
            BoxShape{2 * vec_of(static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin())});
      case CYLINDER_SHAPE_PROXYTYPE: {
        const auto& cylinder = static_cast<const btCylinderShape&>(shape);
        const int axis = cylinder.getUpAxis();
        const double height = 2 * static_cast<double>(cylinder.getHalfExtentsWithMargin()[axis]);
        return solid(at * along_z(axis), CylinderShape{cylinder.getRadius(), height});
      }
      case CONVEX_HULL_SHAPE_PROXYTYPE:
        return solid(at, hull_of(static_cast<const btConvexHullShape&>(shape)));
      case TRIANGLE_MESH_SHAPE_PROXYTYPE:
        return append_triangles(touched_, static_cast<const btBvhTriangleMeshShape&>(shape), at);
      case COMPOUND_SHAPE_PROXYTYPE: {
        const auto& compound = static_cast<const btCompoundShape&>(shape);
        for (int i = 0; i < compound.getNumChildShapes(); ++i)
          add(name, *compound.getChildShape(i), at * compound.getChildTransform(i));
        return;
      }
      default:
        refuse(path_, name + ": a " + shape.getName() +
                          "; boxes, cylinders, hulls, triangle meshes and compounds are known");
    }
  }

  void finish(const btCollisionShape* rays) {
    if (rays && rays->getShapeType() == TRIANGLE_MESH_SHAPE_PROXYTYPE)
      append_triangles(file_.seen, static_cast<const btBvhTriangleMeshShape&>(*rays),
                       btTransform::getIdentity());
    if (!touched_.triangles.empty() || file_.seen.triangles.empty()) {
      file_.seen = touched_;
      for (const ExportBody& solid : file_.solids) append(file_.seen, mesh_of(solid));
    }
    if (!touched_.triangles.empty()) file_.solids.clear();
  }

 private:
  std::filesystem::path path_;
  BulletFile& file_;
  Mesh touched_;  // the triangle meshes among the bodies
};

BulletFile load(const std::filesystem::path& path) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  btBulletWorldImporter importer(&world);
  if (!importer.loadFile(path.c_str())) refuse(path, "Bullet cannot read it");
  BulletFile file;
  Reader reader(path, file);
  for (int i = 0; i < importer.getNumRigidBodies(); ++i) {
    const btCollisionObject* body = importer.getRigidBodyByIndex(i);
    if (!body->isStaticObject() || !body->getCollisionShape()) continue;
    const char* name = importer.getNameForPointer(body);
    reader.add(name ? name : "body " + std::to_string(i + 1), *body->getCollisionShape(),
               body->getWorldTransform());
  }
  reader.finish(importer.getCollisionShapeByName("rays"));
  importer.deleteAllData();
  return file;
}

// Whether the file begins like one of Bullet's and its chunks fill it up to the types at its end.
bool is_whole(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (bytes.size() < 12 || !bytes.starts_with("BULLET")) return false;
  const std::size_t head = bytes[7] == '-' ? 24 : 20;  // by the size of a pointer
  for (std::size_t at = 12; at + head <= bytes.size();) {
    std::int32_t length = 0;
    std::memcpy(&length, bytes.data() + at + 4, sizeof(length));
    if (length < 0 || static_cast<std::size_t>(length) > bytes.size() - at - head) return false;
    if (bytes.compare(at, 4, "DNA1") == 0) return true;
    at += head + static_cast<std::size_t>(length);
  }
  return false;
}

}  // namespace

BulletFile read_bullet(const std::filesystem::path& path) {
  if (!is_whole(path)) refuse(path, "not a .bullet file, or not all of one");
  if (!comes_to_end([&] { load(path); })) refuse(path, "damaged; Bullet's reader fails on it");
  const Stopwatch watch;
  BulletFile file = load(path);
  file.seconds = watch.wall();
  return file;
}

}  // namespace scanworld::sim
