// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/columns.h"

#include <set>

#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

constexpr double kColumnSpacing = 0.015;

// An upright prism of 2 m on a regular polygon, or with facets = 0 a cylinder.
PointCloud column(double radius, int facets, double noise, Random& random, double arc = 2 * M_PI) {
  PointCloud cloud;
  const int count = static_cast<int>(arc * radius * 2 / (kColumnSpacing * kColumnSpacing));
  for (int i = 0; i < count; ++i) {
    const double angle = random.uniform(0, arc);
    double r = radius;
    if (facets > 0) {
      const double wide = 2 * M_PI / facets, off = std::fmod(angle, wide) - wide / 2;
      r = radius * std::cos(wide / 2) / std::cos(off);
    }
    r += noise * random.gauss();
    cloud.points.push_back(
        Vec3(r * std::cos(angle), r * std::sin(angle), random.uniform(0, 2)).cast<float>());
  }
  return cloud;
}

// How many facets are left where the points were taken to be those of as many equal facets.
std::size_t left(const PointCloud& cloud, int facets, double noise) {
  const Stages s = run_stages(cloud, known_scale(noise, kColumnSpacing), false);
  const Clustering start = label_sites(s.grid, [&](const Vec3& p) {
    const double angle = std::atan2(p.y(), p.x());
    return static_cast<std::int32_t>((angle < 0 ? angle + 2 * M_PI : angle) / (2 * M_PI / facets));
  });
  const Clustering c = drop_columns(s.grid, s.neighbors, s.scale, start);
  std::set<std::int32_t> labels(c.label.begin(), c.label.end());
  labels.erase(kNone);
  return labels.size();
}

}  // namespace

TEST_CASE("the facets of a round column go, those of an octagonal one stay") {
  Random random(1);
  for (double noise : {0.003, 0.01})
    for (double radius : {0.2, 0.3, 0.5}) {
      CAPTURE(noise);
      CAPTURE(radius);
      CHECK(left(column(radius, 0, noise, random), 8, noise) == 0);
      CHECK(left(column(radius, 8, noise, random), 8, noise) == 8);
    }
}

TEST_CASE("half of a column, seen from one side, is told as well") {
  Random random(2);
  CHECK(left(column(0.3, 0, 0.006, random, M_PI), 8, 0.006) == 0);
  CHECK(left(column(0.3, 8, 0.006, random, M_PI), 8, 0.006) == 4);
}

TEST_CASE("a curve wider than a column is left to its facets") {
  Random random(3);
  CHECK(left(column(1.5, 0, 0.005, random), 24, 0.005) == 24);
}

TEST_CASE("the faces of a square pillar stay") {
  Random random(4);
  CHECK(left(column(0.3, 4, 0.008, random), 4, 0.008) == 4);
}
