// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "ode.h"

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>

#include "error.h"
#include "timing.h"

namespace scanworld::sim {

namespace {

constexpr int kContactsOfPair = 32;

// Where ODE would end the program.
void throw_ode_error(int number, const char* format, va_list arguments) {
  char text[500];
  std::vsnprintf(text, sizeof(text), format, arguments);
  throw Error(Cause::failure, "ODE: error " + std::to_string(number) + ": " + text);
}

// Before any call that finds contacts. ODE keeps buffers for each thread, and frees them at its
// end; ODE itself is never closed, as a simulation may live as long as the program.
void prepare_ode() {
  static const bool in_program = [] {
    dSetErrorHandler(throw_ode_error);
    dSetDebugHandler(throw_ode_error);
    return dInitODE2(0) != 0;
  }();
  static thread_local const bool in_thread =
      in_program && dAllocateODEDataForThread(dAllocateMaskAll) != 0;
  if (!in_thread) throw Error(Cause::failure, "ODE: it can not be started");
}

struct OdeDeleter {
  void operator()(dxWorld* world) const { dWorldDestroy(world); }
  void operator()(dxSpace* space) const { dSpaceDestroy(space); }
  void operator()(dxGeom* geom) const { dGeomDestroy(geom); }
  void operator()(dxJointGroup* group) const { dJointGroupDestroy(group); }
  void operator()(dxTriMeshData* data) const { dGeomTriMeshDataDestroy(data); }
};
template <typename T>
using OdePtr = std::unique_ptr<T, OdeDeleter>;

Vec3 ode_vec(const dReal* v) { return {v[0], v[1], v[2]}; }

// A geom of triangles, and the arrays that ODE refers to.
class OdeMesh {
 public:
  OdeMesh(const Mesh& mesh, dSpaceID space) : data_(dGeomTriMeshDataCreate()) {
    for (const Vec3& v : mesh.vertices)
      for (int k = 0; k < 3; ++k) vertices_.push_back(static_cast<float>(v[k]));
    for (const auto& t : mesh.triangles)
      for (int corner : t) corners_.push_back(static_cast<dTriIndex>(corner));
    dGeomTriMeshDataBuildSingle(data_.get(), vertices_.data(), 3 * sizeof(float),
                                static_cast<int>(mesh.vertices.size()), corners_.data(),
                                static_cast<int>(corners_.size()), 3 * sizeof(dTriIndex));
    geom = dCreateTriMesh(space, data_.get(), nullptr, nullptr, nullptr);
  }
  dGeomID geom;  // the space's

 private:
  std::vector<float> vertices_;
  std::vector<dTriIndex> corners_;
  OdePtr<dxTriMeshData> data_;
};

class Ode : public Simulation {
 public:
  Ode(const Place& place, const std::vector<Pose>& robots, const RobotOptions& robot,
      const EngineOptions& options)
      : robot_(robot), friction_(options.friction) {
    dWorldSetGravity(world_.get(), 0, 0, place.sort == Sort::empty ? 0 : -options.gravity);
    dWorldSetERP(world_.get(), 0.8);
    dWorldSetCFM(world_.get(), 1e-4);
    dWorldSetAutoDisableFlag(world_.get(), 0);
    dGeomRaySetClosestHit(ray_.get(), 1);
    add_place(place);
    for (const Pose& pose : robots) add_robot(pose);
  }

  void step(double seconds) override {
    find_contacts();
    solve(seconds);
  }

  void collide() override { find_contacts(); }

  std::size_t contacts() const override { return touching_.size(); }

  Vec3 position(std::size_t robot) const override {
    return ode_vec(dBodyGetPosition(chassis_[robot]));
  }
  Vec3 velocity(std::size_t robot) const override {
    return ode_vec(dBodyGetLinearVel(chassis_[robot]));
  }

  void put(std::size_t robot, const Pose& pose, const Vec3& velocity, const Vec3& spin) override {
    set(chassis_[robot], pose, velocity, spin);
    if (arms_.empty()) return;
    const Pose arm = arm_at(pose);
    set(arms_[robot], arm, velocity + spin.cross(arm.position - pose.position), spin);
  }

  void push(std::size_t robot, const Vec3& force) override {
    dBodyAddForce(chassis_[robot], force.x(), force.y(), force.z());
  }

  void bend(std::size_t robot, double speed) override {
    if (!hinges_.empty()) dJointSetHingeParam(hinges_[robot], dParamVel, speed);
  }

  double cast(const Vec3& from, const Vec3& to) override {
    prepare_ode();
    const Vec3 way = to - from;
    const double length = way.norm();
    if (length == 0) return 1;
    dGeomRaySetLength(ray_.get(), length);
    dGeomRaySet(ray_.get(), from.x(), from.y(), from.z(), way.x(), way.y(), way.z());
    double nearest = length;
    dSpaceCollide2(ray_.get(), reinterpret_cast<dGeomID>((rays_ ? rays_ : statics_).get()),
                   &nearest, [](void* data, dGeomID a, dGeomID b) {
                     dContactGeom hit;
                     double& least = *static_cast<double*>(data);
                     if (dCollide(a, b, 1, &hit, sizeof(hit)) > 0)
                       least = std::min(least, hit.depth);
                   });
    return nearest / length;
  }

  Phases step_by_phases(double seconds) override {
    const Stopwatch watch;
    find_contacts();
    const double found = watch.cpu();
    solve(seconds);
    return {.narrowphase = found, .solver = watch.cpu() - found};
  }

 private:
  struct Touching {
    dContactGeom point;
    double friction;
  };

  void find_contacts() {
    prepare_ode();
    touching_.clear();
    const auto meet = [](void* self, dGeomID a, dGeomID b) { static_cast<Ode*>(self)->meet(a, b); };
    dSpaceCollide(movers_.get(), this, meet);
    dSpaceCollide2(reinterpret_cast<dGeomID>(movers_.get()),
                   reinterpret_cast<dGeomID>(statics_.get()), this, meet);
  }

  void meet(dGeomID a, dGeomID b) {
    const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
    // What belongs together is joined by a hinge.
    if (body_a && body_b && dAreConnected(body_a, body_b)) return;
    std::array<dContactGeom, kContactsOfPair> points;
    const int count = dCollide(a, b, kContactsOfPair, points.data(), sizeof(dContactGeom));
    const double friction = robot_.friction * (body_a && body_b ? robot_.friction : friction_);
    for (int i = 0; i < count; ++i) touching_.push_back({points[i], friction});
  }

  void solve(double seconds) {
    for (const Touching& t : touching_) {
      dContact contact{};
      contact.surface.mode = dContactApprox1;  // else mu is a force
      contact.surface.mu = t.friction;
      contact.geom = t.point;
      const dJointID joint = dJointCreateContact(world_.get(), joints_.get(), &contact);
      dJointAttach(joint, dGeomGetBody(t.point.g1), dGeomGetBody(t.point.g2));
    }
    // It solves in an order that it shuffles, by a state that the whole program shares.
    dRandSetSeed(shuffle_);
    dWorldQuickStep(world_.get(), seconds);
    shuffle_ = dRandGetSeed();
    dJointGroupEmpty(joints_.get());
  }

  void add_place(const Place& place) {
    const dSpaceID space = statics_.get();
    if (place.sort == Sort::plane) dCreatePlane(space, 0, 0, 1, place.height);
    for (const ExportBody& solid : place.solids) {
      const dGeomID geom = geom_of_solid(solid);
      dGeomSetPosition(geom, solid.position.x(), solid.position.y(), solid.position.z());
      const Eigen::Quaterniond& q = solid.rotation;
      const dQuaternion turn = {q.w(), q.x(), q.y(), q.z()};
      dGeomSetQuaternion(geom, turn);
    }
    if (place.seen.triangles.empty()) return;
    if (!place.solids.empty()) rays_.reset(dHashSpaceCreate(nullptr));
    meshes_.push_back(std::make_unique<OdeMesh>(place.seen, rays_ ? rays_.get() : space));
  }

  // A hull is a mesh of its faces: as dCreateConvex it gives a box one contact a step, so that
  // cubes at rest on a slab tilt, and some fall through.
  dGeomID geom_of_solid(const ExportBody& solid) {
    const dSpaceID space = statics_.get();
    if (const auto* box = std::get_if<BoxShape>(&solid.shape))
      return dCreateBox(space, box->size.x(), box->size.y(), box->size.z());
    if (const auto* cylinder = std::get_if<CylinderShape>(&solid.shape))
      return dCreateCylinder(space, cylinder->radius, cylinder->height);
    const Mesh& mesh = std::get<ConvexShape>(solid.shape).mesh;
    meshes_.push_back(std::make_unique<OdeMesh>(mesh, space));
    return meshes_.back()->geom;
  }

  // The masses and sizes are those of the Symbrion modules, as in the Bullet adapter.
  void add_robot(const Pose& pose) {
    const double size = robot_.size;
    dMass mass;
    if (robot_.kind == RobotKind::ball) {
      dMassSetSphereTotal(&mass, 1, size / 2);
      chassis_.push_back(add_body(mass, dCreateSphere(movers_.get(), size / 2), pose));
      return;
    }
    dMassSetBoxTotal(&mass, 1, size, size, size);
    chassis_.push_back(add_body(mass, dCreateBox(movers_.get(), size, size, size), pose));
    if (robot_.kind == RobotKind::module) add_arm(pose);
  }

  void add_arm(const Pose& pose) {
    const Vec3 size = robot_.size * Vec3(0.17, 1, 1);
    dMass mass;
    dMassSetBoxTotal(&mass, 0.2, size.x(), size.y(), size.z());
    arms_.push_back(
        add_body(mass, dCreateBox(movers_.get(), size.x(), size.y(), size.z()), arm_at(pose)));
    const dJointID hinge = dJointCreateHinge(world_.get(), nullptr);
    dJointAttach(hinge, arms_.back(), chassis_.back());
    dJointSetHingeAnchor(hinge, pose.position.x(), pose.position.y(), pose.position.z());
    const Vec3 axis = -(pose.rotation * Vec3::UnitY());
    dJointSetHingeAxis(hinge, axis.x(), axis.y(), axis.z());
    dJointSetHingeParam(hinge, dParamLoStop, -M_PI / 2);
    dJointSetHingeParam(hinge, dParamHiStop, M_PI / 2);
    dJointSetHingeParam(hinge, dParamFMax, 200 * robot_.size);
    hinges_.push_back(hinge);
  }

  Pose arm_at(const Pose& pose) const {
    return {pose.position + pose.rotation * Vec3(0.75 * robot_.size, 0, 0), pose.rotation};
  }

  dBodyID add_body(const dMass& mass, dGeomID geom, const Pose& pose) {
    const dBodyID body = dBodyCreate(world_.get());
    dBodySetMass(body, &mass);
    dGeomSetBody(geom, body);
    set(body, pose, Vec3::Zero(), Vec3::Zero());
    return body;
  }

  static void set(dBodyID body, const Pose& pose, const Vec3& velocity, const Vec3& spin) {
    const Eigen::Quaterniond& q = pose.rotation;
    const dQuaternion turn = {q.w(), q.x(), q.y(), q.z()};
    dBodySetPosition(body, pose.position.x(), pose.position.y(), pose.position.z());
    dBodySetQuaternion(body, turn);
    dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
    dBodySetAngularVel(body, spin.x(), spin.y(), spin.z());
    dBodySetForce(body, 0, 0, 0);
    dBodySetTorque(body, 0, 0, 0);
  }

  RobotOptions robot_;
  double friction_;  // of the place
  // Geoms go before the bodies and meshes that they refer to.
  OdePtr<dxWorld> world_{dWorldCreate()};
  OdePtr<dxJointGroup> joints_{dJointGroupCreate(0)};
  std::vector<std::unique_ptr<OdeMesh>> meshes_;
  OdePtr<dxSpace> movers_{dHashSpaceCreate(nullptr)}, statics_{dHashSpaceCreate(nullptr)}, rays_;
  OdePtr<dxGeom> ray_{dCreateRay(nullptr, 1)};
  std::vector<dBodyID> chassis_, arms_;
  std::vector<dJointID> hinges_;
  std::vector<Touching> touching_;
  unsigned long shuffle_ = 0;
};

}  // namespace

std::unique_ptr<Simulation> make_ode(const Place& place, const std::vector<Pose>& robots,
                                     const RobotOptions& robot, const EngineOptions& options) {
  prepare_ode();
  return std::make_unique<Ode>(place, robots, robot, options);
}

}  // namespace scanworld::sim
