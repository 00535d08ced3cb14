// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "bullet.h"

#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>
#include <btBulletDynamicsCommon.h>

#include <cstring>
#include <memory>

#include "bodies.h"
#include "error.h"
#include "files.h"
#include "parts.h"

namespace scanworld {

namespace {

// A quantized tree has 21 bits for the number of a triangle.
constexpr std::size_t kMostTriangles = (1u << 21) - 1;

btVector3 vector_of(const Vec3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

btTransform transform_of(const ExportBody& body) {
  const Eigen::Quaterniond& q = body.rotation;
  return btTransform(btQuaternion(static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()),
                                  static_cast<btScalar>(q.z()), static_cast<btScalar>(q.w())),
                     vector_of(body.position));
}

std::unique_ptr<btCollisionShape> shape_of(const ExportBody& body) {
  if (const auto* box = std::get_if<BoxShape>(&body.shape))
    return std::make_unique<btBoxShape>(vector_of(box->size / 2));
  if (const auto* cylinder = std::get_if<CylinderShape>(&body.shape))
    return std::make_unique<btCylinderShapeZ>(
        vector_of({cylinder->radius, cylinder->radius, cylinder->height / 2}));
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& v : std::get<ConvexShape>(body.shape).mesh.vertices)
    hull->addPoint(vector_of(v), false);
  hull->setMargin(0);  // else it would be that much larger
  hull->recalcLocalAabb();
  return hull;
}

// The triangles that rays meet. Bullet refers to the arrays of the mesh, so they live together.
struct RayMesh {
  std::vector<float> vertices;
  std::vector<int> corners;
  btTriangleIndexVertexArray arrays;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
  btTriangleInfoMap edges;

  explicit RayMesh(const Mesh& mesh) {
    for (const Vec3& v : mesh.vertices)
      for (int k = 0; k < 3; ++k) vertices.push_back(static_cast<float>(v[k]));
    for (const auto& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
    btIndexedMesh part;
    part.m_numTriangles = static_cast<int>(mesh.triangles.size());
    part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(corners.data());
    part.m_triangleIndexStride = 3 * sizeof(int);
    part.m_numVertices = static_cast<int>(mesh.vertices.size());
    part.m_vertexBase = reinterpret_cast<const unsigned char*>(vertices.data());
    part.m_vertexStride = 3 * sizeof(float);
    part.m_vertexType = PHY_FLOAT;
    arrays.addIndexedMesh(part, PHY_INTEGER);
    shape = std::make_unique<btBvhTriangleMeshShape>(&arrays, true);
    btGenerateInternalEdgeInfo(shape.get(), &edges);
  }
};

// Bullet writes what it allocated without filling the gaps; here they are zero, so that the same
// world gives the same bytes.
class ZeroedSerializer : public btDefaultSerializer {
 public:
  unsigned char* internalAlloc(size_t size) override {
    unsigned char* memory = btDefaultSerializer::internalAlloc(size);
    std::memset(memory, 0, size);
    return memory;
  }
};

// A world that can be written with a shape that belongs to no body.
class BulletWorld : public btDiscreteDynamicsWorld {
 public:
  using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;
  const btCollisionShape* extra = nullptr;

  void serialize(btSerializer* serializer) override {
    serializer->startSerialization();
    serializeDynamicsWorldInfo(serializer);
    serializeCollisionObjects(serializer);
    serializeRigidBodies(serializer);
    if (extra) extra->serializeSingleShape(serializer);
    serializer->finishSerialization();
  }
};

}  // namespace

void write_bullet(const std::filesystem::path& path, const World& world,
                  const ExportOptions& options) {
  const std::vector<ExportBody> bodies = export_bodies(world, options);
  const std::vector<ExportPart> seen = export_parts(world, {.merge = true});
  const Mesh mesh = seen.empty() ? Mesh{} : seen[0].mesh;
  if (mesh.triangles.size() > kMostTriangles)
    throw Error(Cause::usage, path.string() + ": " + std::to_string(mesh.triangles.size()) +
                                  " triangles; Bullet takes " + std::to_string(kMostTriangles));

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  BulletWorld bullet(&dispatcher, &broadphase, &solver, &configuration);
  bullet.setGravity(vector_of(gravity_of(world)));

  ZeroedSerializer serializer;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> rigid_bodies;
  for (const ExportBody& body : bodies) {
    shapes.push_back(shape_of(body));
    btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, shapes.back().get());
    info.m_startWorldTransform = transform_of(body);
    info.m_friction = static_cast<btScalar>(options.friction);
    rigid_bodies.push_back(std::make_unique<btRigidBody>(info));
    serializer.registerNameForPointer(rigid_bodies.back().get(), body.name.c_str());
    bullet.addRigidBody(rigid_bodies.back().get());
  }
  std::optional<RayMesh> rays;
  if (!mesh.triangles.empty()) {
    rays.emplace(mesh);
    bullet.extra = rays->shape.get();
    serializer.registerNameForPointer(rays->shape.get(), "rays");
  }
  bullet.serialize(&serializer);
  for (const auto& body : rigid_bodies) bullet.removeRigidBody(body.get());

  OutputFile file(path);
  file.write(serializer.getBufferPointer(),
             static_cast<std::size_t>(serializer.getCurrentBufferSize()));
  file.commit();
}

}  // namespace scanworld
