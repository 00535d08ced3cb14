// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "viewer/camera.h"

#include "support/scenes.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// Where a point is in a picture: -1 to 1 from the lower left.
Vec2 in_picture(const Camera& camera, const Vec3& p, double aspect) {
  const Vec3 way = p - camera.eye;
  const double depth = camera.orthographic ? 1 : way.dot(camera.ahead);
  const double half = camera.half_height * depth;
  return {way.dot(camera.right) / (half * aspect), way.dot(camera.up) / half};
}

}  // namespace

TEST_CASE("from the top and from a corner all of a world is in the picture, and nearly fills it") {
  for (const std::string name : {"office", "room", "stairs"}) {
    const World world = read_world(in_project("worlds/" + name + ".json"));
    for (const std::string view : {"top", "iso"})
      for (double aspect : {0.5, 1.6, 4.0}) {
        const Camera camera = camera_named(view, world, aspect);
        CHECK(camera.right.cross(camera.up).dot(camera.ahead) == doctest::Approx(-1));
        double most = 0;
        for (const Vec3& v : world.vertices) {
          CHECK((v - camera.eye).dot(camera.ahead) > 0);
          most = std::max(most, in_picture(camera, v, aspect).cwiseAbs().maxCoeff());
        }
        CHECK(most < 1);
        CHECK(most > 0.9);
      }
  }
}

TEST_CASE("obstacles beyond all surfaces are in the picture too") {
  World world = small_world();
  const Vec3 far = bounds(world).max() + Vec3(30, 0, 0);
  world.obstacles.push_back({.id = 0, .shape = OrientedBox{far, {1, 1, 1}}});
  CHECK(in_picture(camera_from_top(world, 1), far, 1).cwiseAbs().maxCoeff() < 1);
}

TEST_CASE("from the top x goes right and y goes up, and what is up in the world faces the viewer") {
  World world = small_world();
  const Camera upright = camera_from_top(world, 1);
  CHECK((upright.right - Vec3::UnitX()).norm() < 1e-9);
  CHECK((upright.up - Vec3::UnitY()).norm() < 1e-9);
  world.frame.up = Vec3(0, -1, 0);  // as of a depth camera
  CHECK((camera_from_top(world, 1).ahead - Vec3(0, 1, 0)).norm() < 1e-9);
  CHECK(camera_from_corner(world, 1).up.dot(world.frame.up) > 0.5);
}

TEST_CASE("from a place one looks at the middle of the world") {
  const World world = small_world();
  const Camera camera = camera_named("1, -7.5,2", world, 1);
  CHECK((camera.eye - Vec3(1, -7.5, 2)).norm() < 1e-9);
  CHECK_FALSE(camera.orthographic);
  CHECK(in_picture(camera, bounds(world).center(), 1).norm() < 1e-9);
  // Where the place is the middle itself, one looks somewhere all the same.
  CHECK(camera_at(world, bounds(world).center()).ahead.allFinite());
}

TEST_CASE("what is no view is refused by name") {
  for (const std::string view : {"", "left", "1,2", "1,2,3,4", "1;2;3", "nan,0,0", "1,2,x"})
    CHECK(contains(error_of(Cause::usage, [&] { camera_named(view, small_world(), 1); }),
                   "--from: '" + view + "' is none of top, iso and a place x,y,z"));
}
