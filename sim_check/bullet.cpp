// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "bullet.h"

#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>
#include <LinearMath/btQuickprof.h>

#include <cstring>

#include "exporters/bullet_shapes.h"
#include "timing.h"

namespace scanworld::sim {

namespace {

// Groups. A robot's own parts are kept apart by their joint.
constexpr int kSolids = btBroadphaseProxy::StaticFilter, kRobots = btBroadphaseProxy::DefaultFilter,
              kRays = btBroadphaseProxy::SensorTrigger;

btScalar scalar(double x) { return static_cast<btScalar>(x); }
btVector3 bt(const Vec3& v) { return bullet_vector(v); }
btTransform bt(const Pose& pose) { return bullet_transform(pose.position, pose.rotation); }
Vec3 vec(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

// Prisms meet robots by their faces, not by one point a step, which lets robots sink into walls
// (Bullet's initializePolyhedralFeatures); clutter is round, with faces too small for that to help.
std::unique_ptr<btCollisionShape> shape_of(const ExportBody& body) {
  auto shape = bullet_shape(body);
  if (!body.is_obstacle && shape->getShapeType() == CONVEX_HULL_SHAPE_PROXYTYPE)
    static_cast<btConvexHullShape&>(*shape).initializePolyhedralFeatures();
  return shape;
}

bool put_right_at_edges(btManifoldPoint& point, const btCollisionObjectWrapper* a, int part_a,
                        int index_a, const btCollisionObjectWrapper* b, int part_b, int index_b) {
  if (b->getCollisionShape()->getShapeType() == TRIANGLE_SHAPE_PROXYTYPE)
    btAdjustInternalEdgeContacts(point, b, a, part_b, index_b);
  else if (a->getCollisionShape()->getShapeType() == TRIANGLE_SHAPE_PROXYTYPE)
    btAdjustInternalEdgeContacts(point, a, b, part_a, index_a);
  return false;
}

// Hears of the zones that Bullet's steps are made of. Bullet knows functions alone, so the one that
// listens is kept per thread.
class ZoneListener {
 public:
  ZoneListener() {
    now() = this;
    enter_before_ = btGetCurrentEnterProfileZoneFunc();
    leave_before_ = btGetCurrentLeaveProfileZoneFunc();
    btSetCustomEnterProfileZoneFunc([](const char* name) { now()->enter(name); });
    btSetCustomLeaveProfileZoneFunc([] { now()->leave(); });
  }
  ~ZoneListener() {
    btSetCustomEnterProfileZoneFunc(enter_before_);
    btSetCustomLeaveProfileZoneFunc(leave_before_);
  }
  Phases phases;

 private:
  static ZoneListener*& now() {
    static thread_local ZoneListener* listener = nullptr;
    return listener;
  }
  double* phase_of(const char* zone) {
    const auto is = [&](const char* name) { return std::strcmp(zone, name) == 0; };
    if (is("updateAabbs") || is("calculateOverlappingPairs")) return &phases.broadphase;
    if (is("dispatchAllCollisionPairs")) return &phases.narrowphase;
    if (is("solveConstraints")) return &phases.solver;
    return nullptr;
  }
  // Zones nest; only the outermost of those that count is timed.
  void enter(const char* zone) {
    double* phase = inside_ ? nullptr : phase_of(zone);
    open_.push_back(phase);
    if (phase) inside_ = true, since_ = watch_.cpu();
  }
  void leave() {
    if (open_.empty()) return;
    if (double* phase = open_.back()) *phase += watch_.cpu() - since_, inside_ = false;
    open_.pop_back();
  }

  btEnterProfileZoneFunc* enter_before_;
  btLeaveProfileZoneFunc* leave_before_;
  Stopwatch watch_;
  std::vector<double*> open_;
  bool inside_ = false;
  double since_ = 0;
};

struct AnyHit : btCollisionWorld::ContactResultCallback {
  bool touches = false;
  AnyHit() { m_collisionFilterGroup = kRobots, m_collisionFilterMask = kSolids; }
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    touches |= point.getDistance() <= 0;
    return 0;
  }
};

class Bullet : public Simulation {
 public:
  Bullet(const Place& place, const std::vector<Pose>& robots, const RobotOptions& robot,
         const EngineOptions& options)
      : robot_(robot) {
    world_.setGravity({0, 0, scalar(place.sort == Sort::empty ? 0 : -options.gravity)});
    add_place(place, options);
    make_shapes();
    for (const Pose& pose : robots) add_robot(pose);
  }
  ~Bullet() override {
    for (const auto& hinge : hinges_) world_.removeConstraint(hinge.get());
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }

  void step(double seconds) override { world_.stepSimulation(scalar(seconds), 0); }

  void collide() override { world_.performDiscreteCollisionDetection(); }

  std::size_t contacts() const override {
    std::size_t count = 0;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i)
      count +=
          static_cast<std::size_t>(dispatcher_.getManifoldByIndexInternal(i)->getNumContacts());
    return count;
  }

  Vec3 position(std::size_t robot) const override {
    return vec(robots_[robot]->getWorldTransform().getOrigin());
  }
  Vec3 velocity(std::size_t robot) const override {
    return vec(robots_[robot]->getLinearVelocity());
  }

  void put(std::size_t robot, const Pose& pose, const Vec3& velocity, const Vec3& spin) override {
    const btTransform at = bt(pose);
    const auto place = [&](btRigidBody& body, const btTransform& there) {
      body.setWorldTransform(there);
      body.setInterpolationWorldTransform(there);
      body.setLinearVelocity(bt(velocity) + bt(spin).cross(there.getOrigin() - at.getOrigin()));
      body.setAngularVelocity(bt(spin));
      body.clearForces();
    };
    place(*robots_[robot], at);
    if (!arms_.empty()) place(*arms_[robot], at * arm_offset());
  }

  void push(std::size_t robot, const Vec3& force) override {
    robots_[robot]->applyCentralForce(bt(force));
  }

  void bend(std::size_t robot, double speed) override {
    if (!hinges_.empty()) hinges_[robot]->setMotorTargetVelocity(scalar(speed));
  }

  double cast(const Vec3& from, const Vec3& to) override {
    const btVector3 a = bt(from), b = bt(to);
    btCollisionWorld::ClosestRayResultCallback hit(a, b);
    hit.m_collisionFilterGroup = ray_group_;
    hit.m_collisionFilterMask = ray_group_ == kRays ? kRays : kSolids;
    world_.rayTest(a, b, hit);
    return hit.m_closestHitFraction;
  }

  bool has_queries() const override { return true; }

  bool touches(const Vec3& size, const Pose& at) override {
    if (!probe_box_ || probe_size_ != size) {
      probe_box_ = std::make_unique<btBoxShape>(bt(size / 2));
      probe_box_->initializePolyhedralFeatures();
      probe_size_ = size;
      probe_.setCollisionShape(probe_box_.get());
    }
    probe_.setWorldTransform(bt(at));
    AnyHit hit;
    world_.contactTest(&probe_, hit);
    return hit.touches;
  }

  double sweep(const Vec3& size, const Pose& from, const Vec3& to) override {
    const btBoxShape box(bt(size / 2));
    const btTransform a = bt(from), b = bt(Pose{to, from.rotation});
    btCollisionWorld::ClosestConvexResultCallback hit(a.getOrigin(), b.getOrigin());
    hit.m_collisionFilterGroup = kRobots, hit.m_collisionFilterMask = kSolids;
    world_.convexSweepTest(&box, a, b, hit);
    return hit.m_closestHitFraction;
  }

  Phases step_by_phases(double seconds) override {
    ZoneListener listener;
    step(seconds);
    return listener.phases;
  }

 private:
  btRigidBody* add_body(double mass, btCollisionShape* shape, const btTransform& at,
                        double friction, int group, int meets) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape->calculateLocalInertia(scalar(mass), inertia);
    btRigidBody::btRigidBodyConstructionInfo info(scalar(mass), nullptr, shape, inertia);
    info.m_startWorldTransform = at;
    info.m_friction = scalar(friction);
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    btRigidBody* body = bodies_.back().get();
    if (mass > 0) body->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(body, group, meets);
    return body;
  }

  void add_static(btCollisionShape* shape, const btTransform& at, const EngineOptions& options,
                  int group, int meets) {
    add_body(0, shape, at, options.friction, group, meets);
  }

  void add_place(const Place& place, const EngineOptions& options) {
    const btTransform here = btTransform::getIdentity();
    if (place.sort == Sort::plane) {
      shapes_.push_back(
          std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), scalar(place.height)));
      add_static(shapes_.back().get(), here, options, kSolids, kRobots);
    }
    for (const ExportBody& body : place.solids) {
      shapes_.push_back(shape_of(body));
      add_static(shapes_.back().get(), bt(Pose{body.position, body.rotation}), options, kSolids,
                 kRobots);
    }
    if (place.seen.triangles.empty()) return;
    mesh_ = std::make_unique<BulletMesh>(place.seen, options.internal_edges);
    if (place.solids.empty()) {
      add_static(mesh_->shape.get(), here, options, kSolids, kRobots);
      if (options.internal_edges) {
        bodies_.back()->setCollisionFlags(bodies_.back()->getCollisionFlags() |
                                          btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
        gContactAddedCallback = put_right_at_edges;
      }
    } else {
      add_static(mesh_->shape.get(), here, options, kRays, kRays);
      ray_group_ = kRays;
    }
  }

  // The chassis is a cube of mass 1 and the arm a plate of 0.17 x 1 x 1 of mass 0.2, in units of
  // the module; so they weigh in the Symbrion simulator.
  void make_shapes() {
    const double half = robot_.size / 2;
    if (robot_.kind == RobotKind::ball) {
      shape_ = std::make_unique<btSphereShape>(scalar(half));
      return;
    }
    auto box = std::make_unique<btBoxShape>(bt(Vec3::Constant(half)));
    box->initializePolyhedralFeatures();
    shape_ = std::move(box);
    auto arm = std::make_unique<btBoxShape>(bt(half * Vec3(0.17, 1, 1)));
    arm->initializePolyhedralFeatures();
    arm_shape_ = std::move(arm);
  }

  // The arm stands before the chassis, a gap between them; the hinge is in the chassis' middle.
  btTransform arm_offset() const {
    return btTransform(btQuaternion::getIdentity(), bt({0.75 * robot_.size, 0, 0}));
  }

  void add_robot(const Pose& pose) {
    const int meets = kSolids | kRobots;
    btRigidBody* chassis = add_body(1, shape_.get(), bt(pose), robot_.friction, kRobots, meets);
    if (robot_.kind == RobotKind::ball) chassis->setRollingFriction(0);
    robots_.push_back(chassis);
    if (robot_.kind != RobotKind::module) return;
    btRigidBody* arm =
        add_body(0.2, arm_shape_.get(), bt(pose) * arm_offset(), robot_.friction, kRobots, meets);
    arms_.push_back(arm);
    const btVector3 axis(0, 1, 0);
    auto hinge = std::make_unique<btHingeConstraint>(*chassis, *arm, btVector3(0, 0, 0),
                                                     -arm_offset().getOrigin(), axis, axis);
    hinge->setLimit(-SIMD_HALF_PI, SIMD_HALF_PI);
    // 200 in the simulator's units, whose length is the module.
    hinge->enableAngularMotor(true, 0, scalar(200 * robot_.size) / 240);
    world_.addConstraint(hinge.get(), true);
    hinges_.push_back(std::move(hinge));
  }

  RobotOptions robot_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::unique_ptr<BulletMesh> mesh_;
  std::unique_ptr<btCollisionShape> shape_, arm_shape_;  // of the robots
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<btRigidBody*> robots_, arms_;
  std::vector<std::unique_ptr<btHingeConstraint>> hinges_;
  int ray_group_ = kRobots;
  std::unique_ptr<btBoxShape> probe_box_;
  Vec3 probe_size_ = Vec3::Zero();
  btCollisionObject probe_;
};

}  // namespace

std::unique_ptr<Simulation> make_bullet(const Place& place, const std::vector<Pose>& robots,
                                        const RobotOptions& robot, const EngineOptions& options) {
  return std::make_unique<Bullet>(place, robots, robot, options);
}

}  // namespace scanworld::sim
