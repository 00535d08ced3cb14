// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sim_check/ode.h"

#include <thread>

#include "mesh_rays.h"
#include "sim_check/robustness.h"
#include "support/places.h"

using namespace scanworld;
using namespace scanworld::sim;
using namespace scanworld::test;

TEST_CASE("ODE: robots of each kind come to rest on a slab, a hull, a mesh and a plane") {
  const Place places[] = {boxes_place({slab_body()}), boxes_place({slab_hull()}),
                          place_of("mesh", grid_mesh(20, 6)), Place{.sort = Sort::plane}};
  for (const Place& place : places)
    for (RobotKind kind : {RobotKind::cube, RobotKind::module, RobotKind::ball}) {
      INFO(place.name << " " << std::string(name_of(kind)));
      const auto simulation = make_ode(place, {{Vec3(0.1, 0.2, 0.15)}}, {.kind = kind}, {});
      run_for(*simulation, 2);
      CHECK(std::abs(simulation->position(0).z() - 0.05) < 0.001);
      CHECK(simulation->velocity(0).norm() < 0.02);
      CHECK(simulation->contacts() > 0);
    }
}

TEST_CASE("ODE: a cube stands on a cylinder, and on a mesh that looks away from it") {
  const ExportBody pillar = {.position = {0, 0, 0.5},
                             .rotation = Eigen::Quaterniond::Identity(),
                             .shape = CylinderShape{1, 1}};
  const auto simulation = make_ode({.name = "pillar", .sort = Sort::world, .solids = {pillar}},
                                   {{Vec3(0.3, 0.2, 1.1)}}, {}, {});
  run_for(*simulation, 1);
  CHECK(simulation->position(0).z() == doctest::Approx(1.05).epsilon(0.001));
  // There are no triangles, so rays meet the solid.
  CHECK(simulation->cast({0, 0.1, 3}, {0, 0.1, -1}) == doctest::Approx(0.5).epsilon(1e-6));
  CHECK(simulation->cast({1.1, 0, 3}, {1.1, 0, -1}) == 1);
  Mesh mesh = grid_mesh(20, 6);
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  const auto away = make_ode(place_of("away", mesh), {{Vec3(0.1, 0.2, 0.15)}}, {}, {});
  run_for(*away, 1);
  CHECK(away->position(0).z() == doctest::Approx(0.05).epsilon(0.01));
}

TEST_CASE("ODE: rays meet a place where it is, from both sides") {
  for (const Place& place : {boxes_place({slab_body()}), boxes_place({slab_hull()}),
                             place_of("mesh", grid_mesh(20, 6))}) {
    const auto simulation = make_ode(place, {{Vec3(0.1, 0, 0.5)}}, {}, {});
    CHECK(simulation->cast({0.1, 0, 1}, {0.1, 0, -1}) == doctest::Approx(0.5).epsilon(1e-4));
    CHECK(simulation->cast({0.1, 0, -2}, {0.1, 0, 1}) ==
          doctest::Approx(place.sort == Sort::mesh ? 2. / 3 : 1.9 / 3).epsilon(1e-4));
    CHECK(simulation->cast({9, 0, 1}, {9, 0, -1}) == 1);
    CHECK(simulation->cast({0, 0, 1}, {0, 0, 1}) == 1);
  }
}

TEST_CASE("ODE: a simulation goes on in another thread") {
  const Place place = place_of("mesh", grid_mesh(20, 6));
  const auto here = make_ode(place, row_of(3), {}, {}), there = make_ode(place, row_of(3), {}, {});
  run_for(*here, 0.5);
  std::thread([&] { run_for(*there, 0.5); }).join();
  for (std::size_t i = 0; i < 3; ++i) CHECK(here->position(i) == there->position(i));
}
