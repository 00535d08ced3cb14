// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/round_parts.h"

#include "support/clutter.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

constexpr double kRoundCell = 0.05;

std::size_t count_of_rest(const RoundParts& parts) {
  std::size_t count = 0;
  for (const auto& rest : parts.rest) count += rest.size();
  return count;
}

}  // namespace

TEST_CASE("balls that reach into each other are found one by one, whole, each from what is seen") {
  Random random(1);
  const std::vector<std::pair<Vec3, double>> balls = {{{0, 0, 0.3}, 0.3},
                                                      {{0.4, 0, 0.25}, 0.25},
                                                      {{0.1, 0.35, 0.2}, 0.2},
                                                      {{0.15, 0.1, 0.65}, 0.2}};
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < balls.size(); ++k) {
    std::vector<Vec3> own;
    add_ball(own, balls[k].first, balls[k].second, kThingSpacing, kNoise, random);
    for (const Vec3& p : own) {
      bool is_hidden = p.y() - balls[k].first.y() > 0.5 * balls[k].second;  // seen from one side
      for (std::size_t j = 0; j < balls.size(); ++j)
        is_hidden |= j != k && (p - balls[j].first).norm() < balls[j].second;
      if (!is_hidden) points.push_back(p);
    }
  }
  const RoundParts parts = find_round_parts(points, kRoundCell, kNoise);
  CHECK(parts.found.size() == balls.size());
  for (const auto& [center, radius] : balls) {
    double nearest = 1;
    for (const Ellipsoid& e : parts.found)
      nearest = std::min(nearest, (e.center - center).norm() +
                                      (e.radii - Vec3::Constant(radius)).cwiseAbs().maxCoeff());
    CHECK(nearest < 0.05);
  }
  CHECK(count_of_rest(parts) < points.size() / 50);
}

TEST_CASE("what is flat has no round parts") {
  Random random(2);
  std::vector<Vec3> crate, board;
  add_crate(crate, {0, 0, 0.3}, {0.8, 0.5, 0.6}, 0.4, kThingSpacing, kNoise, random);
  add_crate(board, {0, 0, 0.3}, {0.9, 0.4, 0.04}, 0.4, kThingSpacing, kNoise, random);
  for (const auto& points : {crate, board}) {
    const RoundParts parts = find_round_parts(points, kRoundCell, kNoise);
    CHECK(parts.found.empty());
    CHECK(parts.rest.size() == 1);
    CHECK(count_of_rest(parts) == points.size());
  }
}

TEST_CASE("a box on a ball stays, without the ball's points") {
  Random random(3);
  std::vector<Vec3> points;
  add_ball(points, {0, 0, 0.4}, 0.4, kThingSpacing, kNoise, random);
  const std::size_t of_ball = points.size();
  add_crate(points, {0, 0, 1.0}, {0.8, 0.5, 0.4}, 0.4, kThingSpacing, kNoise, random);
  const RoundParts parts = find_round_parts(points, kRoundCell, kNoise);
  REQUIRE(parts.found.size() == 1);
  CHECK((parts.found[0].center - Vec3(0, 0, 0.4)).norm() < 0.02);
  REQUIRE(!parts.rest.empty());
  CHECK(count_of_rest(parts) > (points.size() - of_ball) * 9 / 10);
}
