// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "record.h"

#include <map>
#include <set>

#include "reconstruct.h"
#include "support/scenes.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

const std::vector<Plane> kLevels = {{Vec3::UnitZ(), 0}, {Vec3::UnitZ(), -1}, {Vec3::UnitZ(), -2}};

// Four points each on levels 0, 1 and 2.
std::vector<Vec3> three_squares() {
  std::vector<Vec3> points;
  for (double z : {0.0, 1.0, 2.0})
    for (const Vec2& p : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)})
      points.push_back({p.x(), p.y(), z});
  return points;
}

// The cluster of each shown point after so many steps.
std::vector<std::int32_t> clusters_after(const Replay& replay, std::size_t steps) {
  std::vector<std::int32_t> cluster(replay.points.size(), -1);
  for (std::size_t s = 0; s < steps; ++s)
    for (std::size_t k = 0; k < replay.steps[s].points.size(); ++k)
      cluster[replay.steps[s].points[k]] = replay.steps[s].cluster[k];
  return cluster;
}

}  // namespace

TEST_CASE("clusters keep their numbers when the method numbers them anew") {
  Recorder recorder(true);
  recorder.start("rival", three_squares());
  recorder.add("a", "", {0, 0, 0, 0, 1, 1, 1, 1, -1, -1, -1, -1}, kLevels);
  recorder.add("b", "", {1, 1, 1, 1, 0, 0, 0, 0, 2, 2, 2, 2}, kLevels);
  const Replay replay = *std::move(recorder).finish({}, Vec3::Zero());
  CHECK(replay.steps[0].clusters == 2);
  CHECK(replay.steps[0].changed == 8);
  CHECK(replay.steps[1].clusters == 3);
  CHECK(replay.steps[1].changed == 4);  // the last square alone
  const auto cluster = clusters_after(replay, 2);
  CHECK(cluster[0] == replay.steps[0].cluster[0]);
  CHECK(std::set<std::int32_t>(cluster.begin(), cluster.end()).size() == 3);
}

TEST_CASE(
    "of clusters that are united the larger one lives on; of one that is parted the larger part") {
  Recorder recorder(true);
  recorder.start("rival", three_squares());
  recorder.add("a", "", {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, -1}, kLevels);
  recorder.add("united", "", {2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, -1}, kLevels);
  recorder.add("parted", "", {0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, -1}, kLevels);
  const Replay replay = *std::move(recorder).finish({}, Vec3::Zero());
  const auto first = clusters_after(replay, 1), united = clusters_after(replay, 2),
             parted = clusters_after(replay, 3);
  CHECK(united[8] == first[0]);
  CHECK(parted[8] == first[0]);
  CHECK(parted[0] != first[0]);
  CHECK(parted[0] != first[8]);
  CHECK(parted[11] == -1);
}

TEST_CASE("each cluster is drawn as the convex border of its points, in the world's axes") {
  Recorder recorder(true);
  recorder.start("thesis", three_squares());
  recorder.add("a", "", {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, -1, -1}, kLevels);
  Frame frame;
  frame.origin = {5, 0, 0};
  const Replay replay = *std::move(recorder).finish(frame, {5, 0, 10});
  REQUIRE(replay.steps[0].loops.size() == 2);  // two points have no border
  for (const ReplayLoop& loop : replay.steps[0].loops) {
    CHECK(loop.vertices.size() == 4);
    for (const Vec3& v : loop.vertices) CHECK(v.z() >= 10);
  }
  CHECK((replay.points[0] - Vec3(0, 0, 10)).norm() < 1e-12);
}

TEST_CASE("with cells a cluster is drawn as it is: a wall with its door and its window") {
  const Plane wall{Vec3::UnitY(), -2};
  std::vector<Vec3> points;
  for (double x = 0; x < 6; x += 0.05)
    for (double z = 0; z < 3; z += 0.05)
      if (!(x > 1 && x < 2 && z < 2) && !(x > 3 && x < 5 && z > 1 && z < 2))
        points.push_back({x, 2, z});
  Recorder recorder(true);
  recorder.start("rival", points, 0.1);
  recorder.add("a", "", std::vector<std::int32_t>(points.size(), 0), {wall});
  const Replay replay = *std::move(recorder).finish({}, Vec3::Zero());
  const auto& loops = replay.steps[0].loops;
  REQUIRE(loops.size() == 2);
  CHECK_FALSE(loops[0].is_hole);
  CHECK(loops[1].is_hole);
  const auto area = [](const ReplayLoop& loop) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < loop.vertices.size(); ++k)
      sum += loop.vertices[k].cross(loop.vertices[(k + 1) % loop.vertices.size()]) / 2;
    return sum.norm();
  };
  CHECK(std::abs(area(loops[0]) - (18 - 2)) < 0.8);
  CHECK(std::abs(area(loops[1]) - 2) < 0.4);
  for (const ReplayLoop& loop : loops) {
    CHECK(loop.vertices.size() <= 14);
    for (const Vec3& v : loop.vertices) CHECK(std::abs(wall.normal.dot(v) + wall.offset) < 1e-9);
  }
}

TEST_CASE("a replay shows an even part of many points and counts the changes of all") {
  std::vector<Vec3> points;
  for (int i = 0; i < 10000; ++i) points.push_back({i % 100 * 1.0, i / 100 * 1.0, 0});
  Recorder recorder(true);
  recorder.start("rival", points, 0, 1000);
  recorder.add("a", "", std::vector<std::int32_t>(10000, 0), {Plane{}});
  const Replay replay = *std::move(recorder).finish({}, Vec3::Zero());
  CHECK(replay.points.size() == 1000);
  CHECK(replay.steps[0].changed == 10000);
  CHECK(replay.steps[0].points.size() == 1000);
  std::map<std::pair<int, int>, int> in_square;
  for (const Vec3& p : replay.points) ++in_square[{int(p.x()) / 25, int(p.y()) / 25}];
  REQUIRE(in_square.size() == 16);
  for (const auto& [square, count] : in_square) CHECK(std::abs(count - 62) < 35);
}

TEST_CASE("the cells of space, then what the cut leaves of them, come before the surfaces") {
  ReconstructOptions options{.record = true};
  const ReconstructResult result = reconstruct(room_points({4, 3, 2.5}, 0.05, kNoise), options);
  const std::vector<ReplayStep>& steps = result.replay->steps;
  REQUIRE(steps.size() > 3);
  const auto area_of = [](const ReplayStep& step) {
    double area = 0;
    for (const ReplayLoop& loop : step.loops) {
      Vec3 sum = Vec3::Zero();
      for (std::size_t i = 0; i < loop.vertices.size(); ++i)
        sum += loop.vertices[i].cross(loop.vertices[(i + 1) % loop.vertices.size()]);
      area += sum.norm() / 2;
    }
    return area;
  };
  const double surfaces = 2 * (4 * 3 + 4 * 2.5 + 3 * 2.5);
  const auto end = steps.end();
  CHECK(area_of(end[-3]) > 1.05 * surfaces);  // planes go on beyond the room
  CHECK(area_of(end[-2]) == doctest::Approx(surfaces).epsilon(0.02));
  CHECK(area_of(end[-1]) == doctest::Approx(area_of(end[-2])).epsilon(1e-6));
  CHECK(end[-2].loops.size() >= end[-1].loops.size());
}

TEST_CASE("both methods are recorded stage by stage, without a change to the world") {
  const PointCloud cloud = room_points({4, 3, 2.5}, 0.05, kNoise);
  const std::map<Method, std::vector<std::string>> stages = {
      {Method::rival,
       {"Seeds", "Growth", "Rivalry", "Parting and bridging", "Evidence", "Labelling space"}},
      {Method::thesis, {"Placing", "Spreading", "Final approximation"}}};
  for (const auto& [method, wanted] : stages) {
    ReconstructOptions options{.method = method};
    const ReconstructResult plain = reconstruct(cloud, options);
    CHECK_FALSE(plain.replay);
    options.record = true;
    const ReconstructResult recorded = reconstruct(cloud, options);
    CHECK(world_text(recorded.world) == world_text(plain.world));
    REQUIRE(recorded.replay);
    std::vector<std::string> found;
    for (const ReplayStep& step : recorded.replay->steps)
      if (found.empty() || found.back() != step.stage) found.push_back(step.stage);
    CHECK(found == wanted);
    const ReplayStep& last = recorded.replay->steps.back();
    CHECK(last.clusters == 6);
    // The polygons at the end are those of the world.
    std::size_t near = 0, all = 0;
    for (const ReplayLoop& loop : last.loops)
      for (const Vec3& v : loop.vertices) {
        ++all;
        for (const Vec3& w : recorded.world.vertices)
          if ((v - w).norm() < 1e-5) {
            ++near;
            break;
          }
      }
    CHECK(all >= 24);
    CHECK(near == all);
  }
}
