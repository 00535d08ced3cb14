// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sim_check/mujoco.h"

#include "mesh_rays.h"
#include "sim_check/robustness.h"
#include "support/places.h"

using namespace scanworld;
using namespace scanworld::sim;
using namespace scanworld::test;

namespace {

const ExportBody kMujocoSlab = box_body({-3, -3, -0.1}, {3, 3, 0});

void run_mujoco(Simulation& simulation, double seconds) {
  for (int i = 0; i < 240 * seconds; ++i) simulation.step(1. / 240);
}

// The slab as a hull with an origin and axes of its own.
ExportBody mujoco_hull() {
  ExportBody hull = kMujocoSlab;
  Mesh mesh = mesh_of(hull);
  hull.position = {1, 2, 0.5};
  hull.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()));
  for (Vec3& v : mesh.vertices) v = hull.rotation.conjugate() * (v - hull.position);
  hull.shape = ConvexShape{mesh};
  return hull;
}

// So many in a row along y, which do not touch.
std::vector<Pose> mujoco_row(int count) {
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) poses.push_back({Vec3(0, 0.25 * i - 1, 0.06)});
  return poses;
}

}  // namespace

TEST_CASE("MuJoCo: robots of each kind come to rest on a slab and on a plane") {
  for (const Place& place :
       {boxes_place({kMujocoSlab}), Place{.name = "plane", .sort = Sort::plane}})
    for (RobotKind kind : {RobotKind::cube, RobotKind::module, RobotKind::ball}) {
      INFO(place.name << " " << std::string(name_of(kind)));
      const auto simulation = make_mujoco(place, {{Vec3(0.1, 0.2, 0.15)}}, {.kind = kind}, {});
      run_mujoco(*simulation, 2);
      CHECK(std::abs(simulation->position(0).z() - 0.05) < 0.001);
      CHECK(simulation->velocity(0).norm() < 0.02);
      CHECK(simulation->contacts() > 0);
    }
}

TEST_CASE("MuJoCo: a ball lies on a cylinder and on a hull") {
  const ExportBody pillar = {.position = {0, 0, 0.5},
                             .rotation = Eigen::Quaterniond::Identity(),
                             .shape = CylinderShape{1, 1}};
  const auto simulation = make_mujoco({.name = "pillar", .sort = Sort::world, .solids = {pillar}},
                                      {{Vec3(0.3, 0.2, 1.1)}}, {.kind = RobotKind::ball}, {});
  run_mujoco(*simulation, 1);
  CHECK(simulation->position(0).z() == doctest::Approx(1.05).epsilon(0.001));
  // There are no triangles, so rays meet the solid.
  CHECK(simulation->cast({0, 0.1, 3}, {0, 0.1, -1}) == doctest::Approx(0.5).epsilon(1e-6));
  CHECK(simulation->cast({1.1, 0, 3}, {1.1, 0, -1}) == 1);
  const auto ball = make_mujoco(boxes_place({mujoco_hull()}), {{Vec3(0.1, 0.2, 0.15)}},
                                {.kind = RobotKind::ball}, {});
  run_mujoco(*ball, 1);
  CHECK(ball->position(0).z() == doctest::Approx(0.05).epsilon(0.01));
}

TEST_CASE("MuJoCo: in an empty place nothing falls and nothing is met") {
  const auto simulation = make_mujoco({.sort = Sort::empty}, {{Vec3(0, 0, 1)}}, {}, {});
  run_mujoco(*simulation, 1);
  CHECK(simulation->position(0) == Vec3(0, 0, 1));
  CHECK(simulation->cast({0, 0, 5}, {0, 0, 4}) == 1);
  CHECK(simulation->contacts() == 0);
}

TEST_CASE("MuJoCo: rays meet a place where it is, from both sides, though it be flat") {
  Place flat = boxes_place({kMujocoSlab});
  flat.seen = grid_mesh(1, 6);
  Place hull = boxes_place({mujoco_hull()});
  hull.seen = {};
  for (const Place& place : {boxes_place({kMujocoSlab}), flat, hull}) {
    const auto simulation = make_mujoco(place, {{Vec3(0.1, 0, 0.5)}}, {}, {});
    CHECK(simulation->cast({0.1, 0, 1}, {0.1, 0, -1}) == doctest::Approx(0.5).epsilon(1e-4));
    CHECK(simulation->cast({0.1, 0, -2}, {0.1, 0, 1}) < 0.67);
    CHECK(simulation->cast({9, 0, 1}, {9, 0, -1}) == 1);
    CHECK(simulation->cast({0, 0, 1}, {0, 0, 1}) == 1);
  }
}

TEST_CASE("MuJoCo: rays meet all that is seen of a world, and nothing else") {
  for (const char* name : {"room", "office", "stairs"}) {
    INFO(std::string(name));
    const Place place = place_of(name, world_named(name));
    const MeshRays seen(place.seen);
    const auto simulation = make_mujoco(place, {{Vec3(1, 1, 1)}}, {}, {});
    test::Random random(7);
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 from(1, 1, 0.5 + random.uniform());
      const Vec3 way = random.direction();
      const auto hit = seen.cast(from, way, 30);
      const double range = 30 * simulation->cast(from, from + 30 * way);
      worst = std::max(worst, std::abs(range - (hit ? hit->distance : 30)));
    }
    CHECK(worst < 1e-4);
  }
}

TEST_CASE("MuJoCo: robots are pushed, put and spun as asked for") {
  const auto simulation =
      make_mujoco(boxes_place({kMujocoSlab}), {{Vec3(0, 0, 0.05)}}, {.friction = 0}, {});
  for (int i = 0; i < 240; ++i) {
    simulation->push(0, {1, 0, 0});
    simulation->push(0, {1, 0, 0});
    simulation->step(1. / 240);
  }
  CHECK(simulation->velocity(0).x() == doctest::Approx(2).epsilon(0.02));
  simulation->put(0, {Vec3(1, 1, 0.05)}, {0, -1, 0});
  CHECK(simulation->position(0).isApprox(Vec3(1, 1, 0.05), 1e-6));
  run_mujoco(*simulation, 0.5);
  CHECK(simulation->position(0).y() == doctest::Approx(0.5).epsilon(0.02));
}

TEST_CASE("MuJoCo: a module is spun as one, about the place's axes") {
  const auto module =
      make_mujoco({.sort = Sort::empty}, {{Vec3(0, 0, 1)}}, {.kind = RobotKind::module}, {});
  // Its arm is towards +y then.
  const Pose turned{Vec3(0, 0, 1), Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()))};
  module->put(0, turned, {0, 0, 0}, {0, 1, 0});
  run_mujoco(*module, 0.5);
  CHECK(module->velocity(0).norm() < 1e-3);
  module->put(0, turned, {0, 0, 0}, {0, 0, 1});
  run_mujoco(*module, 2 * M_PI);
  // Once around the middle of both, which goes on as the arm did.
  const double speed = 0.2 / 1.2 * 0.075;
  CHECK((module->position(0) - Vec3(-2 * M_PI * speed, 0, 1)).norm() < 0.003);
}

TEST_CASE("MuJoCo: friction is the product of the place's and the robot's") {
  for (double friction : {0.0, 0.5}) {
    const auto simulation = make_mujoco(boxes_place({kMujocoSlab}), {{Vec3(0, 0, 0.0499)}},
                                        {.friction = friction}, {.friction = 0.4});
    simulation->put(0, {Vec3(0, 0, 0.0499)}, {1, 0, 0});
    run_mujoco(*simulation, 0.25);
    CHECK(simulation->velocity(0).x() ==
          doctest::Approx(1 - 0.25 * friction * 0.4 * 9.81).epsilon(0.02));
  }
}

TEST_CASE("MuJoCo: a module bends, and its parts never meet") {
  const auto simulation =
      make_mujoco({.sort = Sort::empty}, {{Vec3(0, 0, 1)}}, {.kind = RobotKind::module}, {});
  run_mujoco(*simulation, 0.1);
  CHECK(simulation->velocity(0).norm() < 1e-9);
  // The arm passes through where the corners of the chassis are.
  for (int i = 0; i < 96; ++i) {
    simulation->bend(0, 2);
    simulation->step(1. / 240);
    CHECK(simulation->contacts() == 0);
  }
  CHECK(simulation->velocity(0).z() < -0.01);  // as the arm goes up
  // It comes to the stop, where the two have a common centre of mass; then it comes to rest.
  run_mujoco(*simulation, 1.5);
  simulation->bend(0, 0);
  run_mujoco(*simulation, 0.5);
  CHECK((simulation->position(0) - Vec3(0.0052, 0, 0.9899)).norm() < 0.0005);
  CHECK(simulation->velocity(0).norm() < 0.001);
}

TEST_CASE("MuJoCo: contacts are found at the robots' poses, and nothing else is done") {
  const auto simulation = make_mujoco(boxes_place({kMujocoSlab}), mujoco_row(3), {}, {});
  simulation->collide();
  CHECK(simulation->contacts() == 0);
  for (std::size_t i = 0; i < 2; ++i)
    simulation->put(i, {Vec3(double(i), 0, 0.0499)}, Vec3::Zero());
  simulation->collide();
  CHECK(simulation->contacts() == 8);
  CHECK(simulation->position(0) == Vec3(0, 0, 0.0499));
}

TEST_CASE("MuJoCo: the parts of a step are told") {
  const auto simulation = make_mujoco(boxes_place({kMujocoSlab}), mujoco_row(9), {}, {});
  run_mujoco(*simulation, 0.1);
  const Phases phases = simulation->step_by_phases(1. / 240);
  CHECK(phases.narrowphase > 0);
  CHECK(phases.solver > 0);
}

TEST_CASE("MuJoCo: no robot is lost in a room at 2 m/s") {
  const Place place = place_of("room", world_named("room"));
  const Spots spots = find_spots({place}, {.count = 20});
  const Lost lost =
      drive_at(place, spots, {"mujoco", make_mujoco}, 2, 60, {.robots = 20, .seconds = 2});
  CHECK(lost.robots == 20);
  CHECK(lost.lost == 0);
}

TEST_CASE("MuJoCo: the same calls give the same, whatever else is simulated") {
  const Place place = boxes_place({kMujocoSlab, box_body({0.5, -3, 0}, {0.6, 3, 1})});
  const auto run = [&](Simulation* other) {
    const auto simulation = make_mujoco(place, mujoco_row(9), {.kind = RobotKind::module}, {});
    for (int i = 0; i < 240; ++i) {
      for (std::size_t k = 0; k < 9; ++k) simulation->push(k, {8, double(k) - 4, 0});
      for (std::size_t k = 0; k < 9; ++k) simulation->bend(k, i < 120 ? 2 : -2);
      simulation->step(1. / 240);
      if (other) other->step(1. / 240);
    }
    std::vector<Vec3> ends;
    for (std::size_t k = 0; k < 9; ++k) ends.push_back(simulation->position(k));
    return ends;
  };
  const auto first = run(nullptr);
  const auto other = make_mujoco(place, mujoco_row(5), {}, {});
  CHECK(run(other.get()) == first);
  CHECK(run(nullptr) == first);
}

TEST_CASE("MuJoCo: a place that robots would touch the triangles of is refused, by name") {
  const std::string message = error_of(
      Cause::usage, [] { make_mujoco(place_of("dense.ply", grid_mesh(4, 6)), {}, {}, {}); });
  CHECK(contains(message, "dense.ply: a mesh"));
}

TEST_CASE("MuJoCo: numbers without bound are an error, not a new start") {
  const auto simulation = make_mujoco({.sort = Sort::plane}, {{Vec3(0, 0, 1)}}, {}, {});
  simulation->push(0, {1e30, 0, 0});
  CHECK(contains(error_of(Cause::failure, [&] { simulation->step(1. / 240); }), "MuJoCo: "));
}

TEST_CASE("MuJoCo: more contacts than there was space for are all found") {
  std::vector<Pose> heap;
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) heap.push_back({0.0999 * Vec3(x, y, z + 0.5)});
  const auto simulation = make_mujoco(boxes_place({kMujocoSlab}), heap, {}, {});
  simulation->collide();
  CHECK(simulation->contacts() >= 27 * 4 + 36 * 4);
  run_mujoco(*simulation, 0.1);
  CHECK(simulation->position(26).z() > 0.2);
}
