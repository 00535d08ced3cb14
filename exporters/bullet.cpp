// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "bullet.h"

#include <cstring>
#include <memory>

#include "bodies.h"
#include "bullet_shapes.h"
#include "error.h"
#include "files.h"
#include "parts.h"

namespace scanworld {

namespace {

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
  if (mesh.triangles.size() > kMostBulletTriangles)
    throw Error(Cause::usage, path.string() + ": " + std::to_string(mesh.triangles.size()) +
                                  " triangles; Bullet takes " +
                                  std::to_string(kMostBulletTriangles));

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  BulletWorld bullet(&dispatcher, &broadphase, &solver, &configuration);
  bullet.setGravity(bullet_vector(gravity_of(world)));

  ZeroedSerializer serializer;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> rigid_bodies;
  for (const ExportBody& body : bodies) {
    shapes.push_back(bullet_shape(body));
    btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, shapes.back().get());
    info.m_startWorldTransform = bullet_transform(body.position, body.rotation);
    info.m_friction = static_cast<btScalar>(options.friction);
    rigid_bodies.push_back(std::make_unique<btRigidBody>(info));
    serializer.registerNameForPointer(rigid_bodies.back().get(), body.name.c_str());
    bullet.addRigidBody(rigid_bodies.back().get());
  }
  std::optional<BulletMesh> rays;
  if (!mesh.triangles.empty()) {
    rays.emplace(mesh, true);
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
