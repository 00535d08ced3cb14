// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// A .bullet file in Bullet, built twice: with Bullet's single and double precision.
#include <BulletWorldImporter/btBulletWorldImporter.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <memory>

#include "consumer.h"

namespace {

btVector3 vector_of(const Triple& t) {
  return {static_cast<btScalar>(t[0]), static_cast<btScalar>(t[1]), static_cast<btScalar>(t[2])};
}

// Of bodies: solids meet each other, rays their own mesh.
constexpr int kSolids = btBroadphaseProxy::DefaultFilter | btBroadphaseProxy::StaticFilter;
constexpr int kRays = btBroadphaseProxy::SensorTrigger;

class Bullet : public Consumer {
 public:
  explicit Bullet(const std::string& file)
      : dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_),
        importer_(&world_) {
    if (!importer_.loadFile(file.c_str())) throw std::runtime_error("Bullet cannot load " + file);
    for (int i = 0; i < importer_.getNumRigidBodies(); ++i) {
      const btRigidBody* body = btRigidBody::upcast(importer_.getRigidBodyByIndex(i));
      const char* name = importer_.getNameForPointer(body);
      if (!name || !body->isStaticObject())
        throw std::runtime_error("a body without name, or one that moves");
      names_.push_back(name);
      if (std::abs(static_cast<double>(body->getFriction()) - 0.8) > 1e-6)
        throw std::runtime_error("another friction");
    }
    if (btCollisionShape* mesh = importer_.getCollisionShapeByName("rays")) {
      const auto* triangles = static_cast<const btBvhTriangleMeshShape*>(mesh);
      if (!triangles->getTriangleInfoMap()) throw std::runtime_error("no internal edges");
      rays_ = std::make_unique<btRigidBody>(btScalar(0), nullptr, mesh);
      world_.addRigidBody(rays_.get(), kRays, kRays);
    }
  }
  ~Bullet() override {
    if (rays_) world_.removeRigidBody(rays_.get());
    importer_.deleteAllData();
  }

  std::vector<std::string> names() override { return names_; }
  Triple gravity() override {
    const btVector3 g = world_.getGravity();
    return {g.x(), g.y(), g.z()};
  }

  double ray(const Triple& from, const Triple& direction, Meets what) override {
    const double far = 1000;
    const btVector3 a = vector_of(from), b = a + static_cast<btScalar>(far) * vector_of(direction);
    btCollisionWorld::ClosestRayResultCallback hit(a, b);
    hit.m_collisionFilterGroup = hit.m_collisionFilterMask = what == Meets::seen ? kRays : kSolids;
    world_.rayTest(a, b, hit);
    return hit.hasHit() ? far * static_cast<double>(hit.m_closestHitFraction) : -1;
  }

  bool is_free(const Triple& from, const Triple& to, const Triple& size, double yaw) override {
    const btBoxShape box(vector_of(size) / 2);
    const btQuaternion turn(btVector3(0, 0, 1), static_cast<btScalar>(yaw));
    const btVector3 a = vector_of(from), b = vector_of(to);
    btCollisionWorld::ClosestConvexResultCallback hit(a, b);
    hit.m_collisionFilterGroup = hit.m_collisionFilterMask = kSolids;
    world_.convexSweepTest(&box, btTransform(turn, a), btTransform(turn, b), hit);
    return !hit.hasHit();
  }

  std::vector<Triple> drop(double radius, double seconds,
                           const std::vector<Triple>& from) override {
    btSphereShape sphere(static_cast<btScalar>(radius));
    btVector3 inertia;
    sphere.calculateLocalInertia(1, inertia);
    std::vector<std::unique_ptr<btRigidBody>> balls;
    for (const Triple& start : from) {
      btRigidBody::btRigidBodyConstructionInfo info(1, nullptr, &sphere, inertia);
      info.m_startWorldTransform.setOrigin(vector_of(start));
      info.m_rollingFriction = btScalar(0.01);
      balls.push_back(std::make_unique<btRigidBody>(info));
      balls.back()->setActivationState(DISABLE_DEACTIVATION);
      world_.addRigidBody(balls.back().get(), kSolids, kSolids);
    }
    const int steps = static_cast<int>(std::lround(240 * seconds));
    for (int i = 0; i < steps; ++i) world_.stepSimulation(btScalar(1. / 240), 0);
    std::vector<Triple> ends;
    for (const auto& ball : balls) {
      const btVector3 p = ball->getWorldTransform().getOrigin();
      ends.push_back({p.x(), p.y(), p.z()});
      world_.removeRigidBody(ball.get());
    }
    return ends;
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  btBulletWorldImporter importer_;
  std::unique_ptr<btRigidBody> rays_;
  std::vector<std::string> names_;
};

}  // namespace

int main(int argc, char** argv) {
  return serve(argc, argv, [](const std::string& file) { return std::make_unique<Bullet>(file); });
}
