// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/landmarks.h"

#include <Eigen/Eigenvalues>
#include <sstream>

#include "exporters/export.h"
#include "support/scenes.h"
#include "world/assemble.h"
#include "world/level.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// A closed box with its faces to the inside or to the outside.
World box_world(const Vec3& size, bool inside, const Support& support) {
  std::vector<FoundSurface> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true}) {
      const int b = (axis + 1) % 3, c = (axis + 2) % 3;
      std::vector<Vec3> ring(4, Vec3::Zero());
      for (Vec3& p : ring) p[axis] = high ? size[axis] : 0;
      ring[1][b] = ring[2][b] = size[b];
      ring[2][c] = ring[3][c] = size[c];
      Vec3 normal = Vec3::Unit(axis) * (high != inside ? 1 : -1);
      if (normal[axis] < 0) std::reverse(ring.begin(), ring.end());
      faces.push_back({.plane = plane_through(ring[0], normal), .outer = ring, .support = support});
    }
  World world = assemble_world(faces, {});
  return world;
}

std::size_t count(const std::vector<Landmark>& landmarks, LandmarkKind kind) {
  return static_cast<std::size_t>(std::count_if(landmarks.begin(), landmarks.end(),
                                                [&](const Landmark& l) { return l.kind == kind; }));
}

constexpr Support kSeen{10000, 0.01, 1};

}  // namespace

TEST_CASE("a box has eight corners and four upright edges, concave inside, convex outside") {
  for (const bool inside : {true, false}) {
    const World world = box_world({4, 3, 2.5}, inside, kSeen);
    const auto landmarks = find_landmarks(world);
    CHECK(count(landmarks, LandmarkKind::corner) == 8);
    CHECK(count(landmarks, LandmarkKind::edge) == 4);
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      const Landmark& l = landmarks[i];
      CHECK(l.id == static_cast<int>(i));
      CHECK(l.relief == (inside ? Relief::concave : Relief::convex));
      CHECK(l.surfaces.size() == (l.kind == LandmarkKind::corner ? 3 : 2));
      const double height = l.kind == LandmarkKind::corner ? 0 : 2.5;
      CHECK(std::abs((l.top - l.foot).norm() - height) < 1e-9);
    }
  }
}

TEST_CASE("at the corner of a rectangle a plane is known sqrt(7) times worse than in its middle") {
  const auto landmarks = find_landmarks(box_world({4, 3, 2.5}, true, kSeen));
  for (const Landmark& l : landmarks) {
    REQUIRE(l.covariance);
    // Corners of a rectangle: 1 + 3 + 3; half-way up its side: 1 + 3.
    const bool is_corner = l.kind == LandmarkKind::corner;
    const double expected = 0.01 / 100 * std::sqrt(is_corner ? 7 : 4);
    for (int a = 0; a < 3; ++a)
      CHECK(std::abs(std::sqrt((*l.covariance)(a, a)) - (is_corner || a < 2 ? expected : 0)) <
            1e-8);
    CHECK(std::abs((*l.covariance)(0, 1)) < 1e-14);
  }
}

TEST_CASE("covariances are what fits to random points scatter by") {
  // Two walls at an angle, each fitted to noisy points, meet in an upright edge.
  const double angle = 40 * kDegree, noise = 0.02, length = 3, height = 2;
  const std::size_t points = 50;
  const Vec3 ways[2] = {Vec3::UnitX(), Vec3(std::cos(angle), std::sin(angle), 0)};
  std::vector<FoundSurface> walls;
  for (const Vec3& way : ways) {
    const Vec3 end = length * way, up = height * Vec3::UnitZ();
    walls.push_back({.plane = {way.cross(Vec3::UnitZ()), 0},
                     .outer = {Vec3::Zero(), end, end + up, up},
                     .support = {points, noise, 1}});
  }
  const auto landmarks = find_landmarks(assemble_world(walls, {}));
  REQUIRE(landmarks.size() == 1);
  REQUIRE(landmarks[0].covariance);
  const Mat3 claimed = *landmarks[0].covariance;

  Random random(11);
  Mat3 scatter = Mat3::Zero();
  const int runs = 4000;
  for (int run = 0; run < runs; ++run) {
    // Each wall's offset at half of the edge's height, by regression over (along, height).
    double offsets[2];
    for (double& offset : offsets) {
      Mat3 sum = Mat3::Zero();
      Vec3 right = Vec3::Zero();
      for (std::size_t k = 0; k < points; ++k) {
        const Vec3 row(1, random.uniform(0, length), random.uniform(-height / 2, height / 2));
        sum += row * row.transpose();
        right += row * (noise * random.gauss());
      }
      offset = sum.inverse().row(0).dot(right);
    }
    // The point with n * p = offset for both.
    Eigen::Matrix2d normals;
    for (int k = 0; k < 2; ++k)
      normals.row(k) = walls[static_cast<std::size_t>(k)].plane.normal.head<2>().transpose();
    const Vec2 p = normals.inverse() * Vec2(offsets[0], offsets[1]);
    const Vec3 off(p.x(), p.y(), 0);
    scatter += off * off.transpose() / runs;
  }
  CHECK((scatter - claimed).norm() < 0.15 * claimed.norm());
}

TEST_CASE("the sharper two walls meet, the less is known of where along them") {
  double last = 0;
  for (const double degrees : {90.0, 60.0, 30.0, 20.0}) {
    const Vec3 way(std::cos(degrees * kDegree), std::sin(degrees * kDegree), 0);
    std::vector<FoundSurface> walls;
    for (const Vec3& w : {Vec3(Vec3::UnitX()), way})
      walls.push_back({.plane = {w.cross(Vec3::UnitZ()), 0},
                       .outer = {Vec3::Zero(), w, w + Vec3::UnitZ(), Vec3::UnitZ()},
                       .support = kSeen});
    const auto landmarks = find_landmarks(assemble_world(walls, {}));
    REQUIRE(landmarks.size() == 1);
    const double worst =
        Eigen::SelfAdjointEigenSolver<Mat3>(*landmarks[0].covariance).eigenvalues().maxCoeff();
    CHECK(worst > last);
    last = worst;
  }
  // And at less than the least angle there is no landmark.
  const Vec3 way(std::cos(0.2), std::sin(0.2), 0);
  World world =
      assemble_world({{.plane = {Vec3::UnitX().cross(Vec3::UnitZ()), 0},
                       .outer = {Vec3::Zero(), Vec3::UnitX(), Vec3(1, 0, 1), Vec3::UnitZ()}},
                      {.plane = {way.cross(Vec3::UnitZ()), 0},
                       .outer = {Vec3::Zero(), way, way + Vec3::UnitZ(), Vec3::UnitZ()}}},
                     {});
  CHECK(find_landmarks(world).empty());
}

TEST_CASE("what was not measured leaves the uncertainty open") {
  const World world = read_world(in_project("worlds/office.json"));
  const auto landmarks = find_landmarks(world);
  CHECK(count(landmarks, LandmarkKind::corner) > 100);
  CHECK(count(landmarks, LandmarkKind::edge) > 50);
  for (const Landmark& l : landmarks) CHECK_FALSE(l.covariance);
  CHECK(find_landmarks({}).empty());
  CHECK(find_landmarks(small_world()).empty());
}

TEST_CASE("corners are where three planes meet, and edges where two walls do") {
  const World world = read_world(in_project("worlds/stairs.json"));
  for (const Landmark& l : find_landmarks(world)) {
    for (int id : l.surfaces) {
      const Plane& plane = world.surfaces[static_cast<std::size_t>(id)].plane;
      CHECK(std::abs(plane.signed_distance(l.foot)) < 1e-5);
      CHECK(std::abs(plane.signed_distance(l.top)) < 1e-5);
    }
    if (l.kind == LandmarkKind::edge) {
      CHECK((l.top - l.foot).cross(world.frame.up).norm() < 1e-5);
      CHECK((l.top - l.foot).dot(world.frame.up) >= 0.5);
    }
  }
}

TEST_CASE("landmarks move and turn with the world, and so do their covariances") {
  const World world = box_world({4, 3, 2.5}, true, kSeen);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()));
  const Vec3 shift(10, 20, 30);
  const auto here = find_landmarks(world), there = find_landmarks(moved(world, turn, shift));
  REQUIRE(here.size() == there.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    CHECK(here[i].surfaces == there[i].surfaces);
    CHECK((turn * here[i].foot + shift - there[i].foot).norm() < 1e-5);
    const Mat3 turned = turn * *here[i].covariance * turn.conjugate().toRotationMatrix();
    CHECK((turned - *there[i].covariance).norm() < 1e-5 * turned.norm());
  }
}

TEST_CASE("the nearest landmark is the one that a search of all of them gives") {
  const auto landmarks = find_landmarks(box_world({4, 3, 2.5}, true, kSeen));
  Random random(12);
  for (int k = 0; k < 300; ++k) {
    const Vec3 p(random.uniform(-1, 5), random.uniform(-1, 4), random.uniform(-1, 3.5));
    // Within the box's height the edges are nearest, or as near as a corner.
    double least = 1e9;
    for (const double x : {0.0, 4.0})
      for (const double y : {0.0, 3.0})
        least = std::min(least, std::hypot(std::hypot(p.x() - x, p.y() - y),
                                           std::max({0.0, -p.z(), p.z() - 2.5})));
    const Landmark* nearest = nearest_landmark(landmarks, p);
    REQUIRE(nearest);
    const double z = std::clamp(p.z(), nearest->foot.z(), nearest->top.z());
    CHECK((Vec3(nearest->foot.x(), nearest->foot.y(), z) - p).norm() ==
          doctest::Approx(least).epsilon(1e-9).scale(0));
    CHECK((nearest_landmark(landmarks, p, least + 1e-6) == nearest));
    CHECK(nearest_landmark(landmarks, p, least - 1e-6) == nullptr);
  }
  CHECK(nearest_landmark({}, Vec3::Zero()) == nullptr);
}

TEST_CASE("the table of landmarks reads back as what was found") {
  const TempFolder folder;
  World world = box_world({4, 3, 2.5}, true, kSeen);
  for (const bool measured : {true, false}) {
    if (!measured) world.surfaces[0].support = {};
    export_world(world, folder / "w.csv");
    std::istringstream lines(read_file(folder / "w.csv"));
    std::string line;
    std::getline(lines, line);
    const auto columns = std::count(line.begin(), line.end(), ',');
    const auto landmarks = find_landmarks(world);
    for (const Landmark& l : landmarks) {
      REQUIRE(std::getline(lines, line));
      CHECK(std::count(line.begin(), line.end(), ',') == columns);
      std::vector<std::string> cells;
      std::istringstream row(line + ",");
      for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
      CHECK(std::stoi(cells[0]) == l.id);
      CHECK(cells[1] == name_of(l.kind));
      CHECK(cells[2] == name_of(l.relief));
      for (std::size_t a = 0; a < 3; ++a) {
        CHECK(std::stod(cells[3 + a]) == doctest::Approx(l.foot[static_cast<int>(a)]));
        CHECK(std::stod(cells[6 + a]) == doctest::Approx(l.top[static_cast<int>(a)]));
        const auto k = static_cast<int>(a);
        CHECK(cells[10 + a].empty() == !l.covariance);
        if (l.covariance)
          CHECK(std::abs(std::stod(cells[10 + a]) - std::sqrt((*l.covariance)(k, k))) < 1e-9);
      }
    }
    CHECK_FALSE(std::getline(lines, line));
  }
}

TEST_CASE("the YAML of landmarks has an entry a landmark, and its name tells it from a map") {
  const TempFolder folder;
  const World world = box_world({4, 3, 2.5}, true, kSeen);
  export_world(world, folder / "w.landmarks.yaml");
  export_world(world, folder / "v.yaml", {}, "landmarks");
  const std::string text = read_file(folder / "w.landmarks.yaml");
  CHECK(read_file(folder / "v.yaml") == text);
  std::istringstream lines(text);
  std::size_t entries = 0, covariances = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#") || line.starts_with("up: [") || line == "landmarks:") continue;
    // A list of maps: "  - id: 0", then "    key: value".
    CHECK((line.starts_with("  - id: ") || line.starts_with("    ")));
    CHECK(contains(line, ": "));
    CHECK(std::count(line.begin(), line.end(), '[') == std::count(line.begin(), line.end(), ']'));
    if (line.starts_with("  - ")) CHECK(line == "  - id: " + std::to_string(entries++));
    covariances += line.starts_with("    covariance: [");
  }
  CHECK(entries == 12);
  CHECK(covariances == 12);
  export_world({}, folder / "e.landmarks.yaml");
  CHECK(contains(read_file(folder / "e.landmarks.yaml"), "landmarks: []\n"));
}
