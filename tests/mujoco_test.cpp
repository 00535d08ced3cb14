// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sim_check/mujoco.h"

#include "mesh_rays.h"
#include "sim_check/robustness.h"
#include "support/places.h"

using namespace scanworld;
using namespace scanworld::sim;
using namespace scanworld::test;

TEST_CASE("MuJoCo: robots of each kind come to rest on a slab and on a plane") {
  for (const Place& place :
       {boxes_place({slab_body()}), Place{.name = "plane", .sort = Sort::plane}})
    for (RobotKind kind : {RobotKind::cube, RobotKind::module, RobotKind::ball}) {
      INFO(place.name << " " << std::string(name_of(kind)));
      const auto simulation = make_mujoco(place, {{Vec3(0.1, 0.2, 0.15)}}, {.kind = kind}, {});
      run_for(*simulation, 2);
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
  run_for(*simulation, 1);
  CHECK(simulation->position(0).z() == doctest::Approx(1.05).epsilon(0.001));
  // There are no triangles, so rays meet the solid.
  CHECK(simulation->cast({0, 0.1, 3}, {0, 0.1, -1}) == doctest::Approx(0.5).epsilon(1e-6));
  CHECK(simulation->cast({1.1, 0, 3}, {1.1, 0, -1}) == 1);
  const auto ball = make_mujoco(boxes_place({slab_hull()}), {{Vec3(0.1, 0.2, 0.15)}},
                                {.kind = RobotKind::ball}, {});
  run_for(*ball, 1);
  CHECK(ball->position(0).z() == doctest::Approx(0.05).epsilon(0.01));
}

TEST_CASE("MuJoCo: rays meet a place where it is, from both sides, though it be flat") {
  Place flat = boxes_place({slab_body()});
  flat.seen = grid_mesh(1, 6);
  Place hull = boxes_place({slab_hull()});
  hull.seen = {};
  for (const Place& place : {boxes_place({slab_body()}), flat, hull}) {
    const auto simulation = make_mujoco(place, {{Vec3(0.1, 0, 0.5)}}, {}, {});
    CHECK(simulation->cast({0.1, 0, 1}, {0.1, 0, -1}) == doctest::Approx(0.5).epsilon(1e-4));
    CHECK(simulation->cast({0.1, 0, -2}, {0.1, 0, 1}) < 0.67);
    CHECK(simulation->cast({9, 0, 1}, {9, 0, -1}) == 1);
    CHECK(simulation->cast({0, 0, 1}, {0, 0, 1}) == 1);
  }
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
  const auto simulation = make_mujoco(boxes_place({slab_body()}), heap, {}, {});
  simulation->collide();
  CHECK(simulation->contacts() >= 27 * 4 + 36 * 4);
  run_for(*simulation, 0.1);
  CHECK(simulation->position(26).z() > 0.2);
}
