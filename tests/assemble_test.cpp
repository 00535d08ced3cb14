// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/assemble.h"

#include "support/scenes.h"
#include "world/validate.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

FoundSurface level(double x0, double y0, double x1, double y1, double z, bool up) {
  FoundSurface s{.plane = {up ? Vec3(Vec3::UnitZ()) : Vec3(-Vec3::UnitZ()), up ? -z : z},
                 .outer = {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}};
  if (!up) std::reverse(s.outer.begin(), s.outer.end());
  return s;
}

}  // namespace

TEST_CASE("surfaces that meet share their vertices") {
  const World world = small_world();
  CHECK(validate(world).empty());
  CHECK(world.vertices.size() == 4 + 2 + 4);
  CHECK(world.surfaces[0].id == 0);
  CHECK(world.surfaces[1].id == 1);
}

TEST_CASE("vertices nearer than a micrometre are one") {
  FoundSurface a = level(0, 0, 1, 1, 0, true), b = level(1, 0, 2, 1, 0, true);
  b.outer[0].x() += 3e-7;
  CHECK(assemble_world({a, b}, {}).vertices.size() == 6);
}

TEST_CASE("floor, ceiling, wall and table are told apart by slope, facing and place") {
  const FoundSurface floor = level(0, 0, 5, 4, 0, true), ceiling = level(0, 0, 5, 4, 2.7, false),
                     table = level(1, 1, 2, 2, 0.75, true);
  const FoundSurface upper_floor = level(0, 0, 4, 4, 3, true);
  FoundSurface wall{.plane = {Vec3::UnitY(), 0},
                    .outer = {{0, 0, 0}, {0, 0, 2.7}, {5, 0, 2.7}, {5, 0, 0}}};
  FoundSurface edge{.plane = {Vec3::UnitY(), -1},
                    .outer = {{1, 1, 0.7}, {1, 1, 0.75}, {2, 1, 0.75}, {2, 1, 0.7}}};
  const World world = assemble_world({floor, ceiling, wall, table, edge, upper_floor}, {});
  const Kind expected[] = {Kind::floor, Kind::ceiling, Kind::wall,
                           Kind::other, Kind::other,   Kind::floor};
  for (std::size_t i = 0; i < 6; ++i) CHECK(world.surfaces[i].kind == expected[i]);
}

TEST_CASE("the floor of the next room is one, whatever the outline around a corner is") {
  // An L; its bounding box has the other room in it.
  FoundSurface l = level(0, 0, 5, 5, 0, true);
  l.outer = {{0, 0, 0}, {5, 0, 0}, {5, 2, 0}, {2, 2, 0}, {2, 5, 0}, {0, 5, 0}};
  for (const double step : {0.0002, 0.02, 0.1, 0.4}) {
    const World world = assemble_world({l, level(2.1, 2.1, 5, 5, step, true)}, {});
    CHECK(world.surfaces[1].kind == Kind::floor);
  }
  const World stage = assemble_world(
      {level(0, 0, 9, 9, 0, true), level(2, 2, 5, 5, 0.4, true), level(6, 0, 7, 1, 0.4, true)}, {});
  CHECK(stage.surfaces[1].kind == Kind::other);
  CHECK(stage.surfaces[2].kind == Kind::other);
}

TEST_CASE("a place that is tilted, or in a camera's frame, is classified by its own up") {
  const FoundSurface floor = level(0, 0, 5, 4, 0, true),
                     wall{.plane = {Vec3::UnitY(), 0},
                          .outer = {{0, 0, 0}, {0, 0, 2.7}, {5, 0, 2.7}, {5, 0, 0}}};
  const Eigen::Quaterniond to_camera(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()));
  const auto turned = [&](FoundSurface s) {
    s.plane.normal = to_camera * s.plane.normal;
    for (Vec3& v : s.outer) v = to_camera * v;
    return s;
  };
  const World world = assemble_world({turned(floor), turned(wall)}, {.up = -Vec3::UnitY()});
  CHECK(world.surfaces[0].kind == Kind::floor);
  CHECK(world.surfaces[1].kind == Kind::wall);
}

TEST_CASE(
    "a surface that looks away from all its neighbours is turned over, one among others is not") {
  // A box seen from outside.
  const std::array<Vec3, 8> v = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0),
                                 Vec3(0, 0, 2), Vec3(1, 0, 2), Vec3(1, 1, 2), Vec3(0, 1, 2)};
  const std::array<std::array<std::size_t, 4>, 6> faces = {
      {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  std::vector<FoundSurface> box;
  for (const auto& f : faces) {
    FoundSurface s{.outer = {v[f[0]], v[f[1]], v[f[2]], v[f[3]]}, .support = {.points = 1000}};
    s.plane = plane_through(s.outer[0],
                            (s.outer[1] - s.outer[0]).cross(s.outer[2] - s.outer[1]).normalized());
    box.push_back(s);
  }
  const World expected = assemble_world(box, {});
  for (std::size_t k = 0; k < box.size(); ++k)
    CHECK(expected.surfaces[k].plane.normal == box[k].plane.normal);
  for (std::size_t k = 0; k < box.size(); ++k) {
    std::vector<FoundSurface> wrong = box;
    wrong[k].plane = wrong[k].plane.flipped();
    wrong[k].support.points = 10;
    std::reverse(wrong[k].outer.begin(), wrong[k].outer.end());
    const World world = assemble_world(wrong, {});
    CHECK(validate(world).empty());
    for (std::size_t i = 0; i < box.size(); ++i)
      CHECK(world.surfaces[i].plane.normal == box[i].plane.normal);
  }
  // A lone surface, and one that shares too little of its outline, stay as they are.
  FoundSurface fin{.plane = {Vec3::UnitX(), -1},
                   .outer = {v[1], Vec3(1, -9, 0), Vec3(1, -9, 2), v[5]}};
  std::reverse(fin.outer.begin(), fin.outer.end());
  fin.plane = fin.plane.flipped();
  for (const auto& with : {std::vector{fin}, std::vector{box[3], fin}})
    CHECK(assemble_world(with, {}).surfaces.back().plane.normal == fin.plane.normal);
}
