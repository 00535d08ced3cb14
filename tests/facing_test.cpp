// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/facing.h"

#include "support/patches.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

TEST_CASE("the normal points to the viewpoint, or to where normals point") {
  for (double side : {1.0, -1.0}) {
    LabelledScan scan;
    scan.add({0, 0, 0}, {2, 0, 0}, {0, 2, 0});
    scan.cloud.normals.assign(scan.cloud.points.size(), Vec3f(0, 0, static_cast<float>(-side)));
    CHECK(scan.patches()[0].plane.normal.z() == doctest::Approx(-side));
    scan.cloud.viewpoints = {Vec3(1, 1, 0.5 * side)};
    CHECK(scan.patches()[0].plane.normal.z() == doctest::Approx(side));
  }
}

TEST_CASE("the viewpoint that counts is one with a free line, not the nearest one behind a wall") {
  LabelledScan scan;
  for (double y : {3.0, 3.15}) scan.add({0, y, 0}, {4, 0, 0}, {0, 0, 2.5});
  scan.cloud.viewpoints = {Vec3(2, 2.8, 1), Vec3(2, 5, 1)};
  const std::vector<Patch> patches = scan.patches();
  CHECK(patches[0].plane.normal.y() == doctest::Approx(-1));
  CHECK(patches[1].plane.normal.y() == doctest::Approx(1));
}

TEST_CASE("a wall faces the viewpoint that saw its points, though another one is nearer") {
  for (double side : {1.0, -1.0}) {
    LabelledScan scan;
    scan.add({0, 0, 0}, {4, 0, 0}, {0, 0, 2.5});
    scan.cloud.viewpoints = {Vec3(2, 5 * side, 1), Vec3(2, -1 * side, 1)};
    CHECK(scan.patches()[0].plane.normal.y() == doctest::Approx(-side));  // guessed wrongly
    scan.cloud.viewers.assign(scan.cloud.points.size(), 0);
    CHECK(scan.patches()[0].plane.normal.y() == doctest::Approx(side));
    // A few that know say nothing, nor do sides that are as many.
    std::fill(scan.cloud.viewers.begin() + 50, scan.cloud.viewers.end(), -1);
    CHECK(scan.patches()[0].plane.normal.y() == doctest::Approx(-side));
    for (std::size_t i = 0; i < scan.cloud.viewers.size(); ++i)
      scan.cloud.viewers[i] = static_cast<std::int32_t>(i % 2);
    CHECK(scan.patches()[0].plane.normal.y() == doctest::Approx(-side));
  }
}

TEST_CASE("without viewpoints the faces of rooms, walls, boards and boxes look out of them") {
  LabelledScan scan;
  struct Face {
    int plane;
    Vec3 outward;
  };
  std::vector<Face> faces;
  // A box's faces, looking into it or out of it.
  const auto add_box = [&](const Vec3& low, const Vec3& size, double sign) {
    for (int a = 0; a < 3; ++a)
      for (double end : {0.0, 1.0}) {
        const Vec3 u = size[(a + 1) % 3] * Vec3::Unit((a + 1) % 3),
                   v = size[(a + 2) % 3] * Vec3::Unit((a + 2) % 3);
        const Vec3 outward = sign * (2 * end - 1) * Vec3::Unit(a);
        faces.push_back({scan.add(low + end * size[a] * Vec3::Unit(a), u, v), outward});
      }
  };
  add_box({0, 0, 0}, {5, 3, 2.5}, -1);          // a room
  add_box({0, 3.12, 0}, {5, 9, 2.5}, -1);       // a larger one behind a thin wall
  add_box({1, 1, 0.5}, {0.8, 0.4, 1.2}, 1);     // a box
  add_box({2.5, 1, 0.7}, {1.2, 0.8, 0.03}, 1);  // a table's board
  const std::vector<Patch> patches = scan.patches();
  for (const Face& face : faces) {
    CAPTURE(face.plane);
    CHECK(patches[static_cast<std::size_t>(face.plane)].plane.normal.dot(face.outward) > 0.9);
  }
}

namespace {

// The normal of a patch after facing.
Vec3 normal_of(const std::vector<Patch>& patches, int plane) {
  return patches[static_cast<std::size_t>(plane)].plane.normal;
}

// Four walls of a house of this size with its corner at the origin, without points inside.
std::vector<std::pair<int, Vec3>> add_walls(LabelledScan& scan, const Vec3& size) {
  const Vec3 x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  return {{scan.add({0, 0, 0}, x, z), -Vec3::UnitY()},
          {scan.add(y, x, z), Vec3::UnitY()},
          {scan.add({0, 0, 0}, y, z), -Vec3::UnitX()},
          {scan.add(x, y, z), Vec3::UnitX()}};
}

// Ground around a house of this size, and none in it.
std::vector<int> add_ground(LabelledScan& scan, const Vec3& size) {
  const double a = 3, w = size.x() + 2 * a;
  return {scan.add({-a, -a, 0}, {w, 0, 0}, {0, a, 0}),
          scan.add({-a, size.y(), 0}, {w, 0, 0}, {0, a, 0}),
          scan.add({-a, 0, 0}, {a, 0, 0}, {0, size.y(), 0}),
          scan.add({size.x(), 0, 0}, {a, 0, 0}, {0, size.y(), 0})};
}

}  // namespace

TEST_CASE("a house on ground looks outwards, with a gable roof, a flat one or none") {
  for (const char* roof : {"gable", "flat", "none"}) {
    CAPTURE(roof);
    LabelledScan scan;
    const Vec3 size(4, 3, 3);
    const auto walls = add_walls(scan, size);
    const std::vector<int> ground = add_ground(scan, size);
    std::vector<int> roofs;
    if (roof == std::string("flat")) roofs = {scan.add({0, 0, 3}, {4, 0, 0}, {0, 3, 0})};
    if (roof == std::string("gable"))
      roofs = {scan.add({0, 0, 3}, {4, 0, 0}, {0, 1.5, 1}),
               scan.add({0, 3, 3}, {4, 0, 0}, {0, -1.5, 1})};
    const std::vector<Patch> patches = scan.patches();
    for (const auto& [plane, outwards] : walls)
      CHECK(normal_of(patches, plane).dot(outwards) > 0.9);
    for (int plane : ground) CHECK(normal_of(patches, plane).z() > 0.9);
    for (int plane : roofs) CHECK(normal_of(patches, plane).z() > 0.5);
  }
}

TEST_CASE("a room looks inwards, with a ceiling or without, though there is nothing around it") {
  for (bool ceiling : {true, false}) {
    LabelledScan scan;
    const auto walls = add_walls(scan, {4, 3, 2.5});
    const int floor = scan.add({0, 0, 0}, {4, 0, 0}, {0, 3, 0});
    const int top = ceiling ? scan.add({0, 0, 2.5}, {4, 0, 0}, {0, 3, 0}) : -1;
    const std::vector<Patch> patches = scan.patches();
    for (const auto& [plane, outwards] : walls)
      CHECK(normal_of(patches, plane).dot(outwards) < -0.9);
    CHECK(normal_of(patches, floor).z() > 0.9);
    if (ceiling) CHECK(normal_of(patches, top).z() < -0.9);
  }
}

TEST_CASE("terrain looks up, where it is steep and in layers too") {
  LabelledScan scan;
  scan.add({0, 0, 0}, {3, 0, 0}, {0, 3, 0});
  scan.add({3, 0, 0}, {2, 0, 1.2}, {0, 3, 0});
  scan.add({5, 0, 1.2}, {3, 0, 0}, {0, 3, 0});
  scan.add({5, 0, 1.0}, {3, 0, 0}, {0, 3, 0});
  scan.add({0, 3, 0}, {0, 3, -1}, {3, 0, 0});
  for (const Patch& patch : scan.patches()) CHECK(patch.plane.normal.z() > 0.5);
}

TEST_CASE("normals that are zero, not numbers or turned by chance say nothing") {
  for (int kind : {0, 1, 2}) {
    CAPTURE(kind);
    LabelledScan scan;
    const auto walls = add_walls(scan, {4, 3, 2.5});
    scan.add({0, 0, 0}, {4, 0, 0}, {0, 3, 0});
    Random random(5);
    for (std::size_t i = 0; i < scan.cloud.points.size(); ++i) {
      const float sign = random.uniform(0, 1) < 0.55 ? 1 : -1;
      scan.cloud.normals.push_back(kind == 0   ? Vec3f(Vec3f::Zero())
                                   : kind == 1 ? Vec3f(Vec3f::Constant(NAN))
                                               : Vec3f(sign, sign, -sign));
    }
    const std::vector<Patch> patches = scan.patches();
    for (const auto& [plane, outwards] : walls)
      CHECK(normal_of(patches, plane).dot(outwards) < -0.9);
    CHECK(patches.back().plane.normal.z() > 0.9);
  }
}

TEST_CASE("a viewpoint that sees only the backs of a room does not count") {
  for (const Vec3& bad : {Vec3(-9, -8, 0), Vec3(-5000, -90, 40), Vec3(-0.06, 1.5, 1)}) {
    LabelledScan scan;
    const auto walls = add_walls(scan, {4, 3, 2.5});
    scan.add({0, 0, 0}, {4, 0, 0}, {0, 3, 0});
    scan.add({0, 0, 2.5}, {4, 0, 0}, {0, 3, 0});
    for (const std::vector<Vec3>& viewpoints :
         {std::vector<Vec3>{bad}, std::vector<Vec3>{bad, Vec3(2, 1.5, 1.5)}}) {
      scan.cloud.viewpoints = viewpoints;
      const std::vector<Patch> patches = scan.patches();
      for (const auto& [plane, outwards] : walls)
        CHECK(normal_of(patches, plane).dot(outwards) < -0.9);
    }
  }
}

TEST_CASE("a patch and its flipped twin say the same of every place") {
  LabelledScan scan;
  scan.add({0.3, 0, 0}, {2, 0.4, 0}, {0, 1.5, 0.3});
  const Patch patch = scan.patches()[0], other = flipped(patch);
  CHECK(other.plane.normal == -patch.plane.normal);
  for (double a : {-0.1, 0.2, 1.1, 1.9})
    for (double b : {-0.1, 0.7, 1.4}) {
      const Vec3 p = Vec3(0.3, 0, 0) + a * Vec3(1, 0.2, 0) + b * Vec3(0, 0.981, 0.196);
      CHECK(other.hit.is_set(other.frame.to_plane(p)) == patch.hit.is_set(patch.frame.to_plane(p)));
      CHECK(evidence_at(other, p) == evidence_at(patch, p));
    }
  CHECK(flipped(other).evidence == patch.evidence);
}
