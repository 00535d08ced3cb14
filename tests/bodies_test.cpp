// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "exporters/bodies.h"

#include <set>

#include "support/engines.h"
#include "support/scenes.h"
#include "world/colliders.h"
#include "world/solids.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

Box3 box_of(const std::vector<Vec3>& points) {
  Box3 box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

World office() {
  World world = read_world(in_project("worlds/office.json"));
  world.colliders = make_colliders(world);
  return world;
}

}  // namespace

TEST_CASE("a body is where its collider or obstacle is, whatever its axes") {
  World world = office();
  Random random(5);
  for (Collider& c : world.colliders)
    if (auto* box = std::get_if<OrientedBox>(&c.shape))
      box->rotation =
          Eigen::Quaterniond(Eigen::AngleAxisd(random.uniform(0, 3), random.direction()));
  const auto bodies = export_bodies(world, {});
  REQUIRE(bodies.size() == world.colliders.size() + world.obstacles.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Mesh solid =
        i < world.colliders.size()
            ? std::visit([](const auto& shape) { return mesh_of(shape); }, world.colliders[i].shape)
            : mesh_of(world.obstacles[i - world.colliders.size()], world.frame);
    const Box3 expected = box_of(solid.vertices), found = box_of(mesh_of(bodies[i]).vertices);
    CHECK((expected.min() - found.min()).norm() < 1e-9);
    CHECK((expected.max() - found.max()).norm() < 1e-9);
  }
}

TEST_CASE("names of bodies are unique") {
  std::set<std::string> names;
  const auto bodies = export_bodies(office(), {});
  for (const ExportBody& body : bodies) names.insert(body.name);
  CHECK(names.size() == bodies.size());
}

TEST_CASE("solids that are too thin grow away from the free side") {
  World world = office();
  world.obstacles.clear();
  const auto floor = std::find_if(world.surfaces.begin(), world.surfaces.end(),
                                  [](const Surface& s) { return s.kind == Kind::floor; });
  for (double depth : {-0.02, 0.02}) {  // from the front back, and from the back to the front
    const Vec3 back = Vec3(0, 0, depth < 0 ? 0 : -0.02);
    world.colliders.push_back(
        {floor->id,
         ConvexPrism{{back, back + Vec3::UnitX(), back + Vec3::UnitY()}, {0, 0, depth}}});
  }
  const double thickness = 0.3;
  const auto thin = export_bodies(world, {}),
             thick = export_bodies(world, {.min_thickness = thickness});
  REQUIRE(thin.size() == thick.size());
  for (std::size_t i = 0; i < thin.size(); ++i) {
    const int id = world.colliders[i].surface;
    const auto s = std::find_if(world.surfaces.begin(), world.surfaces.end(),
                                [&](const Surface& surface) { return surface.id == id; });
    const auto extent = [&](const ExportBody& body) {
      double low = 1e9, high = -1e9;
      const Mesh mesh = mesh_of(body);
      for (const Vec3& c : mesh.vertices) {
        low = std::min(low, s->plane.normal.dot(c));
        high = std::max(high, s->plane.normal.dot(c));
      }
      return std::pair(low, high);
    };
    const auto [low, high] = extent(thin[i]);
    const auto [thick_low, thick_high] = extent(thick[i]);
    CHECK(std::abs(thick_high - high) < 1e-9);
    CHECK(std::abs(thick_low - std::min(low, high - thickness)) < 1e-9);
  }
}

TEST_CASE("an orientation as roll, pitch and yaw is the orientation") {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    Eigen::Quaterniond q(Eigen::AngleAxisd(random.uniform(-3, 3), random.direction()));
    if (i % 4 == 0)  // straight up and down, where roll and yaw are one
      q = Eigen::AngleAxisd(random.uniform(-3, 3), Vec3::UnitZ()) *
          Eigen::AngleAxisd((i % 8 ? 1 : -1) * M_PI / 2, Vec3::UnitY());
    std::istringstream in(rpy_text(q));
    double roll = 0, pitch = 0, yaw = 0;
    in >> roll >> pitch >> yaw;
    const Eigen::Quaterniond back = Eigen::AngleAxisd(yaw, Vec3::UnitZ()) *
                                    Eigen::AngleAxisd(pitch, Vec3::UnitY()) *
                                    Eigen::AngleAxisd(roll, Vec3::UnitX());
    CHECK(back.angularDistance(q) < 1e-6);
  }
}

TEST_CASE("numbers have no minus before zero, and nine digits") {
  CHECK(text_of(-0.0) == "0");
  CHECK(text_of(Vec3(1, -0.0, 1.0 / 3)) == "1 0 0.333333333");
  CHECK(text_of(512345.678912) == "512345.679");
}
