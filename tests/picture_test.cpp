// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "viewer/picture.h"

#include "parallel.h"
#include "support/scenes.h"
#include "viewer/palette.h"
#include "world/ray_scene.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

std::array<int, 3> pixel(const Image& image, int x, int y) {
  const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(x));
  return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
}

// The hue of a pixel, as the channel order and relation that shading leaves as they are.
double hue_distance(const std::array<int, 3>& seen, const Color& color) {
  const Vec3 a = Vec3(seen[0], seen[1], seen[2]).normalized(),
             b = Vec3(color.r, color.g, color.b).normalized();
  return (a - b).norm();
}

}  // namespace

TEST_CASE("from the top what is in a room is seen in its colour through the ceiling") {
  const World world = read_world(in_project("worlds/office.json"));
  const PictureOptions options{.width = 300, .height = 300};
  const Camera camera = camera_from_top(world, 1);
  const Image image = draw(world, camera, options);
  REQUIRE(image.rgb.size() == 3 * 300 * 300);
  const RayScene scene(world);
  std::size_t looked_at = 0;
  for (const Room& room : world.rooms) {
    const Vec3 way = *room.center - camera.eye;
    const int x = static_cast<int>(150 + 150 * way.dot(camera.right) / camera.half_height),
              y = static_cast<int>(150 - 150 * way.dot(camera.up) / camera.half_height);
    const auto floor = scene.cast(*room.center + Vec3(0, 0, 1.9), -Vec3::UnitZ());
    REQUIRE(floor);
    REQUIRE(floor->is_surface);
    CHECK(hue_distance(pixel(image, x, y), color_of_id(world.surfaces[floor->index].id)) < 0.02);
    ++looked_at;
  }
  CHECK(looked_at == 6);
  CHECK(pixel(image, 0, 0) == std::array<int, 3>{250, 250, 247});
}

TEST_CASE("a picture is the same bytes twice, and for any number of threads") {
  const World world = read_world(in_project("worlds/stairs.json"));
  const Camera camera = camera_from_corner(world, 1.5);
  const PictureOptions options{.width = 240, .height = 160};
  std::string first;
  for (int threads : {1, 2, 0}) {
    const ThreadLimit limit(threads);
    const std::string file = png_of(draw(world, camera, options));
    CHECK(file.starts_with("\x89PNG"));
    if (first.empty()) first = file;
    CHECK(file == first);
  }
}

TEST_CASE("surfaces are seen from their free side alone; panes let through what is behind") {
  World world = small_world();
  const PictureOptions options{.width = 40, .height = 40};
  const Surface& floor = world.surfaces[0];
  REQUIRE(floor.kind == Kind::floor);
  const auto middle = [&](const Vec3& eye) {
    return pixel(draw(world, camera_at(world, eye), options), 20, 20);
  };
  const Vec3 center = bounds(world).center();
  CHECK(middle(center - Vec3(0, 0, 9)) == std::array<int, 3>{250, 250, 247});
  CHECK(hue_distance(middle(center + Vec3(0, 0, 9)), color_of_id(floor.id)) < 0.02);
}

TEST_CASE("an empty world and sizes that make no sense give a blank picture and an error") {
  const Image blank = draw({}, camera_from_top({}, 1), {.width = 3, .height = 2, .samples = 1});
  CHECK(blank.rgb.size() == 18);
  CHECK(contains(error_of(Cause::usage, [] { draw({}, {}, {.width = 0}); }), "0 x 1000 pixels"));
}
