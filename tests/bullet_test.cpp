// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sim_check/bullet.h"

#include "support/places.h"

using namespace scanworld;
using namespace scanworld::sim;
using namespace scanworld::test;

TEST_CASE("robots of each kind come to rest on a slab, on a mesh and on a plane") {
  const Place places[] = {
      boxes_place({slab_body()}), place_of("mesh", grid_mesh(20, 6)), {.sort = Sort::plane}};
  for (const Place& place : places)
    for (RobotKind kind : {RobotKind::cube, RobotKind::module, RobotKind::ball}) {
      INFO(name_of(place.sort) << " " << name_of(kind));
      const auto simulation = make_bullet(place, {{Vec3(0.1, 0.2, 0.15)}}, {.kind = kind}, {});
      run_for(*simulation, 2);
      CHECK(std::abs(simulation->position(0).z() - 0.05) < 0.006);
      CHECK(simulation->velocity(0).norm() < 0.02);
      CHECK(simulation->contacts() > 0);
    }
}

TEST_CASE("rays, boxes and sweeps meet a place where it is") {
  for (const Place& place : {boxes_place({slab_body()}), place_of("mesh", grid_mesh(20, 6))}) {
    const auto simulation = make_bullet(place, {}, {}, {});
    CHECK(simulation->cast({0.1, 0, 1}, {0.1, 0, -1}) == doctest::Approx(0.5).epsilon(1e-4));
    CHECK(simulation->cast({9, 0, 1}, {9, 0, -1}) == 1);
    const Vec3 size(0.2, 0.2, 0.2);
    CHECK(simulation->touches(size, {Vec3(0, 0, 0.09)}));
    CHECK_FALSE(simulation->touches(size, {Vec3(0, 0, 0.2)}));
    CHECK(simulation->sweep(size, {Vec3(0, 0, 1.1)}, {0, 0, 0.1}) ==
          doctest::Approx(1).epsilon(0.01));
    CHECK(simulation->sweep(size, {Vec3(0, 0, 1.1)}, {0, 0, -0.9}) ==
          doctest::Approx(0.5).epsilon(0.01));
  }
}

TEST_CASE("more triangles than fit into one tree are several parts, all of which are met") {
  const Place place = place_of("large", grid_mesh(1050, 10));
  CHECK(place.seen.triangles.size() > (1u << 21));
  const auto simulation = make_bullet(place, {}, {}, {});
  for (double y : {-4.9, 0.0, 4.9})
    CHECK(simulation->cast({0.003, y, 1}, {0.003, y, -1}) == doctest::Approx(0.5).epsilon(1e-4));
}

TEST_CASE("with internal edges a cube slides over a mesh as over a slab") {
  const auto lost = [](bool internal_edges) {
    const auto simulation =
        make_bullet(place_of("mesh", grid_mesh(200, 6)), {{Vec3(-1, 0.013, 0.05)}}, {.friction = 0},
                    {.internal_edges = internal_edges});
    simulation->put(0, {Vec3(-1, 0.013, 0.05)}, {1, 0, 0});
    run_for(*simulation, 1.5);
    return 1 - simulation->velocity(0).x();
  };
  CHECK(lost(false) > 0.05);
  CHECK(lost(true) < 0.01);
}
