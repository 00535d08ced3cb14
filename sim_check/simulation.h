// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "place.h"

namespace scanworld::sim {

struct Pose {
  Vec3 position = Vec3::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

// A cube; a module, which is a cube with an arm on a driven hinge, after the robots of the Symbrion
// project; or a ball.
enum class RobotKind { cube, module, ball };
const char* name_of(RobotKind kind);

struct RobotOptions {
  RobotKind kind = RobotKind::cube;
  double size = 0.1;      // [m] edge of the cube, or diameter of the ball
  double friction = 0.5;  // (Coulomb) times that of the place, as Bullet has it
};

struct EngineOptions {
  double friction = 0.8;        // of the place
  double gravity = 9.81;        // [m/s2]
  bool internal_edges = false;  // Bullet: contacts with a mesh are put right at its inner edges
};

// What the parts of a step took [s], as the engine tells.
struct Phases {
  double broadphase = 0, narrowphase = 0, solver = 0;
};

// A place and robots in a physics engine. Robots are numbered from 0, never sleep, and the parts of
// one never meet. Nothing is random: the same calls give the same.
class Simulation {
 public:
  virtual ~Simulation() = default;

  virtual void step(double seconds) = 0;
  virtual void collide() = 0;  // finds the contacts at the robots' poses, and nothing else
  virtual std::size_t contacts() const = 0;  // points, as found last

  virtual Vec3 position(std::size_t robot) const = 0;
  virtual Vec3 velocity(std::size_t robot) const = 0;
  // With a velocity [m/s] and a spin [rad/s].
  virtual void put(std::size_t robot, const Pose& pose, const Vec3& velocity,
                   const Vec3& spin = Vec3::Zero()) = 0;
  virtual void push(std::size_t robot, const Vec3& force) = 0;  // [N] during the next step
  virtual void bend(std::size_t robot, double speed) = 0;       // [rad/s] of a module's hinge

  // The share of the way at which a ray meets the place; 1 where it meets nothing.
  virtual double cast(const Vec3& from, const Vec3& to) = 0;

  // What not all engines have, by their `has_queries`. Whether a box meets the place; the share
  // of its way that a box can go.
  virtual bool has_queries() const { return false; }
  virtual bool touches(const Vec3& /*size*/, const Pose& /*at*/) { return false; }
  virtual double sweep(const Vec3& /*size*/, const Pose& /*from*/, const Vec3& /*to*/) { return 1; }

  // A step that tells its parts; zeros where the engine can't.
  virtual Phases step_by_phases(double seconds) {
    step(seconds);
    return {};
  }
};

// An engine that can be asked for by name.
struct EngineMaker {
  std::string name;
  std::unique_ptr<Simulation> (*make)(const Place&, const std::vector<Pose>& robots,
                                      const RobotOptions&, const EngineOptions&);
  bool takes_meshes;  // else robots can touch solids alone
};

// Those that this program was built with; Bullet comes first.
const std::vector<EngineMaker>& engines();
// Throws usage naming those that there are.
const EngineMaker& engine_named(const std::string& name);

}  // namespace scanworld::sim
