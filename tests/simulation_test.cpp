// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What all engines do alike.
#include "sim_check/simulation.h"

#include "mesh_rays.h"
#include "sim_check/robustness.h"
#include "support/places.h"

using namespace scanworld;
using namespace scanworld::sim;
using namespace scanworld::test;

TEST_CASE("in every engine in an empty place nothing falls and nothing is met") {
  for (const EngineMaker& engine : engines()) {
    INFO(engine.name);
    const auto simulation = engine.make({.sort = Sort::empty}, {{Vec3(0, 0, 1)}}, {}, {});
    run_for(*simulation, 1);
    CHECK(simulation->position(0) == Vec3(0, 0, 1));
    CHECK(simulation->cast({0, 0, 5}, {0, 0, 4}) == 1);
    CHECK(simulation->contacts() == 0);
  }
}

TEST_CASE("in every engine rays meet all that is seen of a world, and nothing else") {
  for (const EngineMaker& engine : engines()) {
    INFO(engine.name);
    for (const char* name : {"room", "office", "stairs"}) {
      INFO(std::string(name));
      const Place place = place_of(name, world_named(name));
      const MeshRays seen(place.seen);
      const auto simulation = engine.make(place, {{Vec3(1, 1, 1)}}, {}, {});
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
}

TEST_CASE("in every engine robots are pushed, put and spun as asked for") {
  for (const EngineMaker& engine : engines()) {
    INFO(engine.name);
    const auto simulation =
        engine.make(boxes_place({slab_body()}), {{Vec3(0, 0, 0.05)}}, {.friction = 0}, {});
    for (int i = 0; i < 240; ++i) {
      simulation->push(0, {1, 0, 0});
      simulation->push(0, {1, 0, 0});
      simulation->step(1. / 240);
    }
    CHECK(simulation->velocity(0).x() == doctest::Approx(2).epsilon(0.02));
    simulation->put(0, {Vec3(1, 1, 0.05)}, {0, -1, 0});
    CHECK(simulation->position(0).isApprox(Vec3(1, 1, 0.05), 1e-6));
    run_for(*simulation, 0.5);
    CHECK(simulation->position(0).y() == doctest::Approx(0.5).epsilon(0.02));
  }
}

TEST_CASE("in every engine a module is spun as one, about the place's axes") {
  for (const EngineMaker& engine : engines()) {
    INFO(engine.name);
    const auto module =
        engine.make({.sort = Sort::empty}, {{Vec3(0, 0, 1)}}, {.kind = RobotKind::module}, {});
    // Its arm is towards +y then.
    const Pose turned{Vec3(0, 0, 1),
                      Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()))};
    module->put(0, turned, {0, 0, 0}, {0, 1, 0});
    run_for(*module, 0.5);
    CHECK(module->velocity(0).norm() < 1e-3);
    module->put(0, turned, {0, 0, 0}, {0, 0, 1});
    run_for(*module, 2 * M_PI);
    // Once around the middle of both, which goes on as the arm did.
    const double speed = 0.2 / 1.2 * 0.075;
    CHECK((module->position(0) - Vec3(-2 * M_PI * speed, 0, 1)).norm() < 0.003);
  }
}

TEST_CASE("in every engine friction is the product of the place's and the robot's") {
  for (const EngineMaker& engine : engines()) {
    INFO(engine.name);
    for (double friction : {0.0, 0.5}) {
      const auto simulation = engine.make(boxes_place({slab_body()}), {{Vec3(0, 0, 0.0499)}},
                                          {.friction = friction}, {.friction = 0.4});
      simulation->put(0, {Vec3(0, 0, 0.0499)}, {1, 0, 0});
      run_for(*simulation, 0.25);
      CHECK(simulation->velocity(0).x() ==
            doctest::Approx(1 - 0.25 * friction * 0.4 * 9.81).epsilon(0.02));
    }
  }
}

TEST_CASE("in every engine a module bends, and its parts never meet") {
  for (const EngineMaker& engine : engines()) {
    INFO(engine.name);
    const auto simulation =
        engine.make({.sort = Sort::empty}, {{Vec3(0, 0, 1)}}, {.kind = RobotKind::module}, {});
    run_for(*simulation, 0.1);
    CHECK(simulation->velocity(0).norm() < 1e-9);
    // The arm passes through where the corners of the chassis are.
    for (int i = 0; i < 96; ++i) {
      simulation->bend(0, 2);
      simulation->step(1. / 240);
      CHECK(simulation->contacts() == 0);
    }
    CHECK(simulation->velocity(0).z() < -0.01);  // as the arm goes up
    // It comes to the stop, where the two have a common centre of mass; then it comes to rest.
    run_for(*simulation, 1.5);
    simulation->bend(0, 0);
    run_for(*simulation, 0.5);
    CHECK((simulation->position(0) - Vec3(0.0052, 0, 0.9899)).norm() < 0.0005);
    CHECK(simulation->velocity(0).norm() < 0.001);
  }
}

TEST_CASE("in every engine contacts are found at the robots' poses, and nothing else is done") {
  for (const EngineMaker& engine : engines()) {
    INFO(engine.name);
    const auto simulation = engine.make(boxes_place({slab_body()}), row_of(3), {}, {});
    simulation->collide();
    CHECK(simulation->contacts() == 0);
    for (std::size_t i = 0; i < 2; ++i)
      simulation->put(i, {Vec3(double(i), 0, 0.0499)}, Vec3::Zero());
    simulation->collide();
    CHECK(simulation->contacts() == 8);
    CHECK(simulation->position(0).isApprox(Vec3(0, 0, 0.0499), 1e-6));
  }
}

TEST_CASE("in every engine the parts of a step are told") {
  for (const EngineMaker& engine : engines()) {
    INFO(engine.name);
    const auto simulation = engine.make(boxes_place({slab_body()}), row_of(9), {}, {});
    run_for(*simulation, 0.1);
    const Phases phases = simulation->step_by_phases(1. / 240);
    CHECK(phases.narrowphase > 0);
    CHECK(phases.solver > 0);
  }
}

TEST_CASE("in every engine no robot is lost in a room at 2 m/s") {
  for (const EngineMaker& engine : engines()) {
    INFO(engine.name);
    const Place place = place_of("room", world_named("room"));
    const Spots spots = find_spots({place}, {.count = 20});
    const Lost lost =
        drive_at(place, MeshRays(place.seen), spots, engine, 2, 60, {.robots = 20, .seconds = 2});
    CHECK(lost.robots == 20);
    CHECK(lost.at.empty());
  }
}

TEST_CASE("in every engine the same calls give the same, whatever else is simulated") {
  for (const EngineMaker& engine : engines()) {
    INFO(engine.name);
    const Place place = boxes_place({slab_body(), box_body({0.5, -3, 0}, {0.6, 3, 1})});
    const auto run = [&](Simulation* other) {
      const auto simulation = engine.make(place, row_of(9), {.kind = RobotKind::module}, {});
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
    const auto other = engine.make(place, row_of(5), {}, {});
    CHECK(run(other.get()) == first);
    CHECK(run(nullptr) == first);
  }
}
