// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <numeric>

#include "rival/labels.h"
#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

// A room with clutter in it.
Stages room_stages(double noise) {
  PointCloud cloud = room_points({4, 3, 2.5}, 0.03, noise);
  Random random(5);
  for (int i = 0; i < 4000; ++i)
    cloud.points.push_back(
        Vec3(random.uniform(0, 4), random.uniform(0, 3), random.uniform(0, 2.5)).cast<float>());
  return run_stages(std::move(cloud));
}

LabelledPoints label(const Stages& s, const Clustering& c, const LabelOptions& options = {}) {
  return label_points(s.cloud, s.grid, s.neighbors, s.scale, c, options);
}

// Of the planes of a room the one nearest to a point, as axis and end; and its distance.
std::pair<int, double> nearest_face(const Vec3& p, double* second = nullptr) {
  const Vec3 size(4, 3, 2.5);
  std::vector<std::pair<double, int>> faces;
  for (int a = 0; a < 3; ++a) {
    faces.push_back({std::abs(p[a]), 2 * a});
    faces.push_back({std::abs(size[a] - p[a]), 2 * a + 1});
  }
  std::sort(faces.begin(), faces.end());
  if (second) *second = faces[1].first;
  return {faces[0].second, faces[0].first};
}

}  // namespace

TEST_CASE("no point is farther from its plane than the options allow, and labels name planes") {
  for (double noise : {0.003, 0.01, 0.02})
    for (double max_own : {4.0, 1.5}) {
      const Stages s = room_stages(noise);
      const Clustering c = s.confirm();
      const LabelOptions options{.max_own = max_own};
      const LabelledPoints labelled = label(s, c, options);
      CHECK(labelled.planes.size() == 6);
      CHECK(count_of(labelled) == 6);
      REQUIRE(labelled.labels.size() == s.cloud.points.size());
      std::vector<int> counts(labelled.planes.size());
      for (std::size_t i = 0; i < labelled.labels.size(); ++i) {
        const std::int32_t l = labelled.labels[i];
        REQUIRE(l >= kNone);
        REQUIRE(l < static_cast<std::int32_t>(labelled.planes.size()));
        if (l == kNone) continue;
        const LabelledPlane& plane = labelled.planes[static_cast<std::size_t>(l)];
        ++counts[static_cast<std::size_t>(l)];
        const double off =
            std::abs(plane.fit.plane.signed_distance(s.cloud.points[i].cast<double>()));
        CHECK(off <= max_own * plane.noise * (1 + 1e-9));
        const double expected =
            std::hypot(s.scale.noise, std::sqrt(square_bend(plane.fit, s.scale)));
        CHECK(off <= options.max_distance * expected * (1 + 1e-9));
      }
      for (int n : counts) CHECK(n >= options.min_points);
      for (const LabelledPlane& plane : labelled.planes)
        CHECK(plane.noise == doctest::Approx(noise).scale(0).epsilon(0.25));
    }
}

TEST_CASE("nearly all points of a face are of one plane, but those near edges and clutter") {
  const Stages s = room_stages(0.005);
  const LabelledPoints labelled = label(s, s.confirm());
  REQUIRE(labelled.planes.size() == 6);
  std::array<std::array<int, 7>, 6> seen{};
  for (std::size_t i = 0; i < labelled.labels.size(); ++i) {
    double second = 0;
    const auto [face, off] = nearest_face(s.cloud.points[i].cast<double>(), &second);
    if (second < 0.05) continue;
    if (off > 0.04) CHECK(labelled.labels[i] == kNone);
    if (off < 0.01)
      ++seen[static_cast<std::size_t>(face)][static_cast<std::size_t>(labelled.labels[i] + 1)];
  }
  std::array<int, 7> taken{};
  for (const auto& counts : seen) {
    const auto most = std::max_element(counts.begin(), counts.end());
    CHECK(*most > 0.99 * std::accumulate(counts.begin(), counts.end(), 0));
    ++taken[static_cast<std::size_t>(most - counts.begin())];
  }
  CHECK(taken == std::array<int, 7>{0, 1, 1, 1, 1, 1, 1});
}

TEST_CASE("points in an edge go to the plane that is nearer") {
  const Stages s = room_stages(0.003);
  Clustering c = s.confirm();
  std::fill(c.awake.begin(), c.awake.end(), 1);
  const LabelledPoints labelled = label(s, c, {.smoothness = 0});
  std::size_t checked = 0;
  for (std::size_t i = 0; i < s.grid.sites.size(); ++i)
    for (std::uint32_t point : s.grid.points_of(i)) {
      const std::int32_t l = labelled.labels[point];
      const Vec3 p = s.cloud.points[point].cast<double>();
      double second = 0;
      nearest_face(p, &second);
      if (l == kNone || second > 0.02) continue;
      const double own =
          std::abs(labelled.planes[static_cast<std::size_t>(l)].fit.plane.signed_distance(p));
      for (std::uint32_t j : s.neighbors.of(i))
        if (c.label[j] != kNone)
          CHECK(own <= std::abs(c.plane(c.label[j]).signed_distance(p)) + 1e-12);
      ++checked;
    }
  CHECK(checked > 500);
}

TEST_CASE("planes with few points are dropped with their labels, the others renumbered") {
  const Stages s = room_stages(0.005);
  const Clustering c = s.confirm();
  const LabelledPoints all = label(s, c);
  std::vector<std::size_t> counts(all.planes.size());
  for (std::int32_t l : all.labels)
    if (l != kNone) ++counts[static_cast<std::size_t>(l)];
  const std::size_t most = *std::max_element(counts.begin(), counts.end());
  const std::size_t least = *std::min_element(counts.begin(), counts.end());
  REQUIRE(least + 100 < most);
  const LabelledPoints few = label(s, c, {.min_points = static_cast<int>(least + most) / 2});
  REQUIRE(few.sites.size() == c.label.size());
  CHECK(few.planes.size() < all.planes.size());
  CHECK(!few.planes.empty());
  for (std::size_t i = 0; i < few.sites.size(); ++i)
    if (few.sites[i] != kNone)
      CHECK(few.planes[static_cast<std::size_t>(few.sites[i])].fit.plane == c.plane(c.label[i]));
  for (std::size_t i = 0; i < few.labels.size(); ++i) {
    if (few.labels[i] == kNone) continue;
    CHECK(few.planes[static_cast<std::size_t>(few.labels[i])].fit.plane ==
          all.planes[static_cast<std::size_t>(all.labels[i])].fit.plane);
  }
}

TEST_CASE("points that are in no site have no label") {
  PointCloud cloud = room_points({4, 3, 2.5}, 0.03, 0.005);
  const auto in_room = static_cast<std::ptrdiff_t>(cloud.points.size());
  for (int i = 0; i < 5; ++i) cloud.points.emplace_back(900.f, 1.f, 0.f);
  const Stages s = run_stages(std::move(cloud));
  const LabelledPoints labelled = label(s, s.confirm());
  CHECK(labelled.planes.size() == 6);
  CHECK(std::all_of(labelled.labels.begin() + in_room, labelled.labels.end(),
                    [](std::int32_t l) { return l == kNone; }));
}
