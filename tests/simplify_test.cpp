// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/simplify.h"

#include <algorithm>

#include "support/places.h"
#include "world/validate.h"

using namespace scanworld;
using namespace scanworld::test;

TEST_CASE("a world that is simplified is valid, and its floors, ceilings and walls are as before") {
  for (const char* name : {"room", "office", "stairs"})
    for (double size : {0.1, 0.5, 3.0}) {
      INFO(name << " " << size);
      const World world = world_named(name);
      const World less = simplify(world, {.simple_obstacles = true, .min_size = size});
      CHECK(validate(less).empty());
      CHECK(less.surfaces.size() <= world.surfaces.size());
      const std::set<int> kept = surface_ids(less);
      for (const Surface& s : world.surfaces) {
        if (s.kind != Kind::other) CHECK(kept.contains(s.id));
        if (!kept.contains(s.id)) continue;
        const Surface& same = *find_surface(less, s.id);
        CHECK(same.plane == s.plane);
        CHECK(area(less, same) == doctest::Approx(area(world, s)));
      }
      for (const Obstacle& o : less.obstacles) {
        Box3 box;
        for (const Vec3& v : mesh_of(o, less.frame).vertices) box.extend(v);
        CHECK(box.sizes().maxCoeff() >= size);
        CHECK_FALSE(std::holds_alternative<ConvexHull>(o.shape));
      }
    }
  const World world = world_named("office");
  CHECK(simplify(world, {}) == world);
}

TEST_CASE("a hull's simple solid holds all of it, and is the smaller of box and cylinder") {
  Random random(3);
  ConvexHull round, flat;
  for (int i = 0; i < 60; ++i) {
    const double a = random.uniform(0, 2 * M_PI);
    round.vertices.push_back({std::cos(a), std::sin(a), random.uniform(0, 2)});
    flat.vertices.push_back({random.uniform(0, 2), random.uniform(0, 0.2), random.uniform(0, 1)});
  }
  CHECK(std::holds_alternative<Cylinder>(simple_solid(round, Vec3::UnitZ())));
  const Vec3 up = Vec3(0.1, 0.05, 1).normalized();
  const auto solid = simple_solid(flat, up);
  REQUIRE(std::holds_alternative<OrientedBox>(solid));
  const OrientedBox& box = std::get<OrientedBox>(solid);
  for (const Vec3& v : flat.vertices) {
    const Vec3 local = box.rotation.conjugate() * (v - box.center);
    CHECK(((local.cwiseAbs() - box.size / 2).array() < 1e-9).all());
  }
  CHECK((box.rotation * Vec3::UnitZ()).isApprox(up));
}
