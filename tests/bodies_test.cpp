// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "exporters/bodies.h"

#include <set>

#include "support/engines.h"
#include "support/scenes.h"
#include "world/colliders.h"
#include "world/round_solids.h"
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

TEST_CASE("slanted pipes are cylinders, balls and whole cones are told beside their hulls") {
  World world;
  const Vec3 axis = Vec3(1, 2, 0.5).normalized();
  const Vec3 across = frame_of({axis, 0}).u;
  const auto add = [&](const Curve& curve) {
    const int id = static_cast<int>(world.curves.size());
    world.curves.push_back({id, curve});
    world.obstacles.push_back({.id = id, .shape = solid_of(curve, world.frame.up), .curve = id});
  };
  add({{CurveType::cylinder, {1, 2, 3}, axis, 0.2}, -1, 2, across});
  add({{CurveType::sphere, {4, 0, 2}, Vec3::UnitZ(), 1.5}, -1.4, 1.4});
  add({{CurveType::cone, {0, 5, 1}, axis, 0, 0.3}, 0, 1.2, across});
  add({{CurveType::cone, {0, 9, 1}, axis, 0, 0.3}, 0.6, 1.2, across});  // without its tip
  const std::vector<ExportBody> bodies = export_bodies(world, {});
  REQUIRE(bodies.size() == 4);
  const auto& pipe = std::get<CylinderShape>(bodies[0].shape);
  CHECK(pipe.radius == 0.2);
  CHECK(pipe.height == 3);
  CHECK((bodies[0].rotation * Vec3::UnitZ() - axis).norm() < 1e-9);
  CHECK((bodies[0].position - Vec3(1, 2, 3) - axis / 2).norm() < 1e-9);
  REQUIRE(is_ball(bodies[1]));
  CHECK(bodies[1].round->radius == 1.5);
  CHECK((bodies[1].position - Vec3(4, 0, 2)).norm() < 1e-9);
  REQUIRE(bodies[2].round);
  CHECK(bodies[2].round->type == CurveType::cone);
  CHECK(bodies[2].round->height == doctest::Approx(1.2));
  // The tip is up along z, and the hull is where it was.
  const Vec3 tip = bodies[2].position + bodies[2].rotation * Vec3(0, 0, 0.6);
  CHECK((tip - Vec3(0, 5, 1)).norm() < 1e-9);
  CHECK_FALSE(bodies[3].round);
  for (const ExportBody& body : bodies)
    for (const Vec3& v : mesh_of(body).vertices)
      CHECK(std::abs(world.curves[static_cast<std::size_t>(&body - bodies.data())]
                         .curve.shape.signed_distance(v)) < 1e-6);
}
